// Triangles of a mesh have textures of their own; one without has that of the mesh.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <3, 5, -9> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare A = texture { pigment { rgb <1, 0.2, 0.1> } finish { phong 0.6 } }
#declare B = texture { pigment { checker rgb 1, rgb <0, 0.4, 0> scale 0.3 } }
mesh {
  triangle { <-2, -1, 0>, <0, -1, 0>, <-1, 1, 0.5> texture { A } }
  triangle { <0, -1, 0>, <-1, 1, 0.5>, <1, 1, 0> }
  triangle { <0, -1, 0>, <1, 1, 0>, <2, -1, 1> texture { B } }
  pigment { rgb <0.2, 0.3, 1> }
  rotate 20*y translate 0.2*x
}
