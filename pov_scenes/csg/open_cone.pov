// An open cone cut from a block leaves the cone's wall but no floor.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference {
  box { -0.9, 0.9 }
  cone { <0, 0.95, 0>, 0.8, <0, -0.4, 0>, 0.3 open }
  rotate <-35, 25, 0>
  pigment { rgb <0.7, 0.5, 0.8> }
}
