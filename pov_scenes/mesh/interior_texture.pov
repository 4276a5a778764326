// Which side of a triangle is inside follows from its corners, or its normals if it is smooth.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union {
  mesh { triangle { <-2, -0.8, 0>, <-1.2, -0.8, 0>, <-1.6, 0.8, 0> } triangle { <-1.1, -0.8, 0>, <-0.7, 0.8, 0>, <-0.3, -0.8, 0> } }
  mesh {
    smooth_triangle { <0, -0.8, 0>, <-1, 0, -1>, <0.8, -0.8, 0>, <0, 0, -1>, <0.4, 0.8, 0>, <0, 1, -1> }
    smooth_triangle { <0.9, -0.8, 0>, <1, 0, 1>, <1.7, -0.8, 0>, <0, 0, 1>, <1.3, 0.8, 0>, <0, 1, 1> }
  }
  triangle { <1.8, -0.8, 0>, <2.3, -0.8, 0>, <2, 0.8, 0> }
  texture { pigment { rgb <0.3, 0.9, 0.5> } }
  interior_texture { pigment { rgb <0.9, 0.2, 0.2> } }
}
