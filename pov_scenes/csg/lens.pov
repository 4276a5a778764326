// Two spheres intersect in a lens.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
intersection {
  sphere { <0, 0, -1.2>, 1.6 }
  sphere { <0, 0, 1.2>, 1.6 }
  rotate 60*y
  pigment { rgbf <0.9, 0.95, 1, 0.8> }
  finish { phong 0.6 }
  interior { ior 1.5 }
}
