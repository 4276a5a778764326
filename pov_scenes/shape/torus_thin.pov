// A thin torus keeps an unbroken ring.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
torus { 1.5, 0.04 rotate -20*x pigment { rgb <0.9, 0.2, 0.2> } }
torus { 1.1, 0.015 rotate 60*z pigment { rgb <0.1, 0.1, 0.6> } }
