// The old `ior` in a finish refracts like one in an interior.
#version 3.0;
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1, 0, 0>, 0.8 pigment { rgbf <0.9, 0.9, 1, 0.9> } finish { refraction 1 ior 1.4 } }
sphere { <1, 0, 0>, 0.8 pigment { rgbf <1, 0.9, 0.9, 0.9> } finish { ior 1.4 } }
