// A number where a vector is expected stands for all components; a short vector is filled with zeros.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.4 pigment { rgb 0.8 } }
box { -0.3, 0.3 translate <-1.2, 0.2> pigment { rgb <0.9, 0.4> } }
sphere { <1, 0, 0> + 0.2, 0.4 pigment { rgb <0.2, 0.4>*<1, 2, 3> + <0, 0, 0.5> } }
