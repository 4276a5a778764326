// Declared transforms nest, with and without braces.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Turn = transform { rotate 35*y rotate 20*x };
#declare Place = transform { Turn translate <-1.1, 0, 0> };
box { -0.6, 0.6 transform Place pigment { rgb <0.9, 0.4, 0.2> } }
box { -0.6, 0.6 transform { transform { Turn } transform { transform Turn translate <1.1, 0, 0> } } pigment { rgb <0.2, 0.4, 0.9> } }
