// Three equal textures at the corners of a triangle are blended, which differs in the last digits from one alone.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <4, 4, 5> look_at 0 angle 24 }
light_source { <4, 6, 1>, rgb 1 fade_distance 9 fade_power 2 }
#declare T = texture { pigment { rgb <0.8, 0.3, 0.1> } finish { diffuse 0.8 ambient 0 } }
#declare U = texture { pigment { rgb <0.4, 0.3, 0.6> } finish { diffuse 0.8 ambient 0 specular 0.2 } }
mesh2 {
  vertex_vectors { 8, <1, 1, -1>, <1, -1, -1>, <-1, -1, -1>, <-1, 1, -1>, <1, 1, 1>, <1, -1, 1>, <-1, -1, 1>, <-1, 1, 1> }
  texture_list { 2, texture { T }, texture { U } }
  face_indices { 6, <4, 7, 6>, 1, 1, 1, <4, 6, 5>, 1, 1, 1, <0, 4, 5>, 0, 0, 1, <0, 5, 1>, 0, 0, 0, <4, 0, 3>, 0, 0, 0, <4, 3, 7>, 1 }
}
mesh {
  triangle { <-3, -1.5, 3>, <3, -1.5, 3>, <3, -1.5, -3> texture_list { T T T } }
  triangle { <-3, -1.5, 3>, <-3, -1.5, -3>, <3, -1.5, -3> texture { T } }
}
