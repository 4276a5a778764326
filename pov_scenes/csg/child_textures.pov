// Each surface shows the texture of the member that owns it; the hole is as green as the sphere that made it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference {
  box { -0.8, 0.8 pigment { rgb <0.9, 0.3, 0.2> } }
  sphere { <0, 0.2, -0.9>, 0.7 pigment { rgb <0.2, 0.8, 0.3> } }
  cylinder { -2*x, 2*x, 0.4 pigment { rgb <0.3, 0.3, 0.9> } }
  rotate <15, 35, 0>
}
