// Orthographic with an angle.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic angle 50 location <-2, 2, -4> look_at <0, 0.2, 0> }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
cylinder { -y, 0.9*y, 0.7 pigment { rgb <0.6, 0.9, 0.3> } }
