// Normals by indices of their own; triangles behind the last triple are flat.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
mesh2 {
  vertex_vectors { 6, <-1.8,-0.8,0>, <-0.4,-0.8,-0.5>, <-0.4,0.9,-0.5>, <-1.8,0.9,0>, <1.2,-0.8,0>, <1.2,0.9,0> }
  normal_vectors { 3, <-1,0,-2>, <0,0,-1>, <0.5,1,-2> }
  face_indices { 4, <0,1,2>, <0,2,3>, <1,4,5>, <1,5,2> }
  normal_indices { 3, <0,1,1>, <0,1,2>, <1,2,0> }
  pigment { rgb <0.8, 0.8, 0.3> }
}
