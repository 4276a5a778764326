// An object without a texture is black; with only a finish its highlight is seen.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1, 0, 0>, 0.9 }
sphere { <1, 0, 0>, 0.9 finish { phong 1 phong_size 15 } }
