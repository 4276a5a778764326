// In a difference the object that a light looks like cuts the parts before it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 0.8 }
#declare Bulb = light_source { <-0.4, 0.5, -0.7>, rgb 0.4 looks_like { sphere { 0, 0.5 pigment { rgb <0.9, 0.4, 0.2> } } } }
plane { y, -1.5 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference { sphere { 0, 0.9 pigment { rgb 1 } } Bulb translate -2.2*x }
difference { box { -0.8, 0.8 } union { light_source { <3, 5, -4>, rgb 0.2 } cylinder { -z, z, 0.3 } Bulb } pigment { rgb <0.5, 0.9, 0.4> } rotate <20, 30, 0> translate 2.2*x }
