// A torus of negative minor radius shows nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
torus { 0.9, -0.3 pigment { rgb <1, 0, 0> } }
torus { 0.5, 0.2 translate 1.4*x pigment { rgb <0.4, 0.8, 0.4> } }
