// Layers that are all transparent show what is behind the object through their product.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-0.8, -0.9, -0.5>, <0.8, 0.8, 0.1>
  texture { pigment { rgbf <0.9, 0.9, 0.3, 0.9> } }
  texture { pigment { rgbt <0.2, 0.3, 0.9, 0.6> } }
  rotate 20*y
}
