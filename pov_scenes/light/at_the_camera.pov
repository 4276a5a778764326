// A lamp at the camera's place leaves no shadow in sight.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <0, 2, -6>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-0.6, 0, 0>, 0.8 pigment { rgb <0.8, 0.6, 0.9> } finish { phong 0.6 } }
box { <0.6, -1, 0.4>, <1.4, 0.4, 1> pigment { rgb <0.6, 0.9, 0.7> } }
