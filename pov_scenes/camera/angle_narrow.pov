// A narrow angle is a telephoto lens.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 20, -60> look_at 0 angle 4 }
light_source { <-40, 60, -80>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb <0.4, 0.6, 0.9> } }
