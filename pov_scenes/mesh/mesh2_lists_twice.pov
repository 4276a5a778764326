// Of a list that `mesh2` has twice the last one counts.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -5> look_at 0 }
light_source { <5, 8, -9>, 1 }
mesh2 {
  vertex_vectors { 4, <-1, 1, 0>, <1, 1, 0>, <0, -1, 0>, <1, 0, 0> }
  uv_vectors { 3, <0, 0>, <1, 0>, <0, 1> }
  vertex_vectors { 3, <-1, -1, 0>, <1.5, -1, 0>, <0, 1.4, 0> }
  normal_vectors { 3, -z, -z, -z }
  normal_vectors { 3, <-1, 0, -1>, <1, 0, -1>, <0, 1, -1> }
  uv_vectors { 3, <0, 0>, <2, 0>, <0, 1> }
  face_indices { 1, <0, 1, 2> }
  pigment { uv_mapping checker rgb 1 rgb x scale 0.2 }
}
