// Degenerate triangles are left out and the others stay.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
mesh {
  triangle { <-1, -1, 0>, <1, 1, 0>, <0, 0, 0> }
  triangle { <-1, -1, 0>, <-1, -1, 0>, <1, 1, 0> }
  triangle { <-1.5, -0.8, 0>, <-0.2, -0.8, 0>, <-0.9, 0.9, 0> }
  smooth_triangle { <0.2, -0.8, 0>, <-1, 0, 1>, <1.6, -0.8, 0>, <1, 0, -1>, <0.9, 0.9, 0>, <0, 1, -1> }
  pigment { rgb <0.7, 0.9, 0.7> }
}
mesh2 {
  vertex_vectors { 3, <1.8, -0.8, 0>, <2.2, -0.8, 0>, <2, 0.9, 0> }
  face_indices { 3, <0, 0, 1>, <0, 1, 2>, <2, 2, 2> }
  pigment { rgb <0.9, 0.7, 0.7> }
}
