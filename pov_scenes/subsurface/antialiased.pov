// Subsurface light with antialiasing, whose rays draw random numbers in their order.
// switches: +A0.1
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 1 subsurface { samples 10, 10 } }
camera { location <0, 0, -5> look_at 0 angle 36 }
light_source { <3, 5, -6>, rgb .5 }
sphere { 0, .8 pigment { rgb <.95, .9, .85> } finish { ambient 0 diffuse .9 subsurface { translucency <30, 20, 10> } } interior { ior 1.3 } }
sphere { <.5, 0, 2>, 1 pigment { rgb <.5, .9, .85> } finish { ambient 0 diffuse .9 subsurface { translucency <3, 2, 10> } } interior { ior 1.5 } }
plane { z, 4 pigment { checker rgb .8 rgb .5 } finish { ambient .1 diffuse .7 } }
