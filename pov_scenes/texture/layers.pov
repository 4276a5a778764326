// Layers lie on each other: the last one is on top and shows those below where it is clear.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1.1
  texture { pigment { rgb <0.9, 0.8, 0.2> } }
  texture { pigment { checker rgbt 1, rgb <0.7, 0.1, 0.1> scale 0.4 } finish { phong 0.8 } }
}
