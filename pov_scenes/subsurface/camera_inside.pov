// Subsurface light seen from inside the body.
#version 3.7;
global_settings { assumed_gamma 1 subsurface { samples 10, 10 } }
camera { location <0, 0, -5> look_at 0 angle 60 }
light_source { <3, 5, -6>, rgb .3 }
light_source { <1, -2, -3>, rgb <.1, .2, .3> }
light_source { <0, 0, 20>, rgb .3 }
sphere { 0, 8 pigment { rgb <.9, .6, .3> } finish { ambient 0 diffuse 1 subsurface { translucency <1.1, .8, .5> } } interior { ior 1.4 } }
