// The camera stands in a closed cylinder and sees wall and far cap.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, 0.2> look_at <0.2, 0.1, 3> angle 80 }
light_source { <0.2, 0.3, 0.5>, rgb 1 }
cylinder { 0, 4*z, 1 pigment { checker rgb 0.9, rgb <0.7, 0.2, 0.2> scale 0.5 } }
