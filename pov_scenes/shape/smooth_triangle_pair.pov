// Two smooth triangles with the same normals on their common edge shade as one surface.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare A = <-1.3, -0.7, 0>;
#declare B = <1.3, -0.7, 0>;
#declare C = <1.3, 1, 0>;
#declare D = <-1.3, 1, 0>;
union {
  smooth_triangle { A, <-1, -1, -2>, B, <1, -1, -2>, C, <1, 1, -2> }
  smooth_triangle { A, <-1, -1, -2>, C, <1, 1, -2>, D, <-1, 1, -2> }
  pigment { rgb <0.4, 0.6, 0.9> }
  finish { specular 0.6 roughness 0.03 }
}
