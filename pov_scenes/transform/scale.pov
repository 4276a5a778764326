// Scaling by a vector makes an ellipsoid and keeps the shading right.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1 scale <0.4, 1, 0.7> translate -1.4*x pigment { rgb <0.9, 0.4, 0.4> } finish { phong 0.8 } }
sphere { 0, 1 scale <1.2, 0.3, 0.8> rotate 30*z translate 0.9*x pigment { rgb <0.4, 0.4, 0.9> } finish { phong 0.8 } }
