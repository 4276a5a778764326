// `uv_mapping`: meshes by `uv_vectors` and `uv_indices`; a mesh without them has one colour.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare K = pigment { checker rgb <1, 0.8, 0.2> rgb <0.1, 0.3, 0.8> scale <0.1, 0.125, 1> }
#declare M = mesh2 { vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0>, <1, 1, 0>, <-1, 1, 0> } uv_vectors { 4, <0, 0>, <1, 0>, <1, 1>, <0, 1> } face_indices { 2, <0, 1, 2>, <0, 2, 3> } }
object { M pigment { uv_mapping K } rotate 30*y translate <-2.2, 1.1, 0> }
mesh2 { vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0>, <1, 1, 0>, <-1, 1, 0> } uv_vectors { 4, <0, 0>, <1, 0>, <1, 1>, <0, 1> } face_indices { 2, <0, 1, 2>, <0, 2, 3> } uv_indices { 2, <0, 1, 2>, <1, 2, 3> }
  texture { uv_mapping pigment { K } finish { phong 1 } } rotate -30*y translate <0.4, 1.1, 0> }
mesh { triangle { <-1, -1, 0>, <1, -1, 0>, <0, 1, 0> uv_vectors <0, 0>, <1, 0>, <0.5, 1> } triangle { <1, -1, 0>, <2, 1, 0>, <0, 1, 0> } pigment { uv_mapping K } translate <-1.4, -1.2, 0> }
mesh2 { vertex_vectors { 3, <0, -1, 0>, <2, -1, 0>, <1, 1, 0> } face_indices { 1, <0, 1, 2> } pigment { uv_mapping K } translate <1, -1.2, 0> }
