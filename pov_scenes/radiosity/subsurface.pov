// Subsurface light that includes radiosity.
#version 3.7;
global_settings { assumed_gamma 1 subsurface { samples 10, 10 radiosity on } radiosity { count 20 error_bound .8 recursion_limit 1 } }
camera { location <0, 2, -5> look_at <0, .6, 0> angle 40 }
light_source { <4, 6, -4>, rgb .5 }
sky_sphere { pigment { rgb <.4, .5, .7> } }
plane { y, 0 pigment { rgb <.8, .7, .5> } }
sphere { <0, .9, 0>, .8 pigment { rgb <.9, .8, .7> } finish { subsurface { translucency <2, 1, .5> } } interior { ior 1.4 } }
