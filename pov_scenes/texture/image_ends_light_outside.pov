// The shadow of a triangle with a transparent image within its pigment: only its interior texture lets light through.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -5> look_at 0 angle 45 }
light_source { <-2, 6, -2>, 1 }
plane { y, -1 pigment { checker rgb 1 rgb 0.5 } }
mesh {
  triangle { <-1, 0.3, -1>, <1, 0.3, -1>, <0, 0.3, 1> uv_vectors <0, 0>, <1, 0>, <0.5, 1> }
  texture { pigment { uv_mapping image_map { png "images/rgb.png" transmit all 0.7 } } }
  interior_texture { pigment { rgb <1, 0.3, 0.2> transmit 0.6 } }
}
