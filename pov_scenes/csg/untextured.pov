// A solid without any texture is black with the default finish, also where an untextured member cuts.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference {
  box { -0.8, 0.8 pigment { rgb <0.9, 0.8, 0.6> } }
  sphere { <0, 0, -0.9>, 0.6 }
  rotate 25*y
}
