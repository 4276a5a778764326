// Triangles of a mesh2 have one texture, three or that of the mesh; degenerate ones are left out with theirs.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <3, 5, -9> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
mesh2 {
  vertex_vectors { 6, <-2, -1, 0>, <0, -1, -1>, <-1, 1, 0.5>, <1, 1, 0>, <2, -1, 1>, <0, 2, 0> }
  normal_vectors { 6, <-1, 0, -1>, <0, -1, -1>, <-1, 1, -1>, <1, 1, -1>, <1, 0, -1>, <0, 1, -1> }
  texture_list {
    3,
    texture { pigment { rgb <1, 0.2, 0.1> } finish { phong 0.6 } }
    texture { pigment { checker rgb 1, rgb <0, 0.4, 0> scale 0.3 } },
    texture { pigment { rgb <0, 0.2, 1> } finish { ambient 0.3 } }
  }
  face_indices { 5, <0, 1, 2>, 0, <1, 1, 2>, 2, <1, 2, 3>, <1, 3, 4>, 0, 1, 2, <2, 3, 5>, 0 + 1 }
  pigment { rgb <0.9, 0.9, 0.2> }
  scale <1, 0.9, 1> rotate 15*y
}
