// Numbers with and without digits round the point, with exponents of both signs.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.5, .2, 0>, 5e-1 pigment { rgb <.9, 1.E-1, 0.> } }
sphere { <0, 0.1e1 - 1, 0>, 50E-2 pigment { rgb <9e-1, .9e0, 1e-10> } }
sphere { <150e-2, 0, 0>, +.5 pigment { rgb <1.e-1, 0.5, 000.9> } }
