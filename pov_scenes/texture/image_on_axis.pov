// Images on the axis of their cylinder and torus, where POV-Ray shows none: triangles without texture coordinates.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> look_at 0 angle 40 }
light_source { <-4, 7, -6>, 1 }
plane { -z, -2 pigment { checker rgb 1 rgb <0.3, 0.5, 0.4> scale 0.4 } }
#macro Pair (Image, Across)
  mesh {
    triangle { <-0.4, -1, 0>, <0.4, -1, 0>, <-0.4, -0.1, 0> }
    triangle { <-0.4, 0.2, 0>, <0.4, 0.2, 0>, <-0.4, 1, 0> uv_vectors <0.2, 0.1>, <1, 0.2>, <0.3, 0.9> }
    texture { pigment { uv_mapping Image } }
    translate Across * x
  }
#end
Pair (pigment { image_map { png "images/rgb.png" map_type 1 } }, -0.9)
Pair (pigment { image_map { png "images/rgb.png" map_type 2 } }, 0)
Pair (pigment { image_map { png "images/rgb.png" map_type 5 } }, 0.9)
