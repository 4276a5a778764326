// Total reflection in a prism: it shows no tint of the surface and no mirror of the finish.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
intersection {
  plane { -y, 0.9 }
  plane { <1, 1, 0>, 0.5 }
  plane { <-1, 1, 0>, 0.5 }
  plane { z, 0.7 }
  plane { -z, 0.7 }
  rotate <-10, 35, 0>
  pigment { rgbf <0.7, 0.9, 1, 0.9> }
  finish { reflection 0.1 }
  interior { ior 1.6 }
}
