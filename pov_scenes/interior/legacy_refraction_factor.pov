// The old `refraction` in a finish is a factor on the light that passes each surface.
#version 3.0;
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.4, 0, 0>, 0.6 pigment { rgbf <0.9, 0.9, 1, 0.9> } finish { refraction 0 } }
sphere { <0, 0, 0>, 0.6 pigment { rgbf <0.9, 0.9, 1, 0.9> } finish { refraction 0.5 } }
sphere { <1.4, 0, 0>, 0.6 pigment { rgbf <0.9, 0.9, 1, 0.9> } finish { refraction 1.3 } }
