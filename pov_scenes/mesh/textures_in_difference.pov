// Triangles keep their own textures inside CSG.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <3, 5, -9> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare A = texture { pigment { rgb <1, 0.2, 0.1> } }
#declare B = texture { pigment { rgb <0.1, 1, 0.2> } finish { phong 0.6 } }
difference {
  mesh {
    triangle { <-1, -1, -1>, <1, -1, -1>, <0, 1, 0> texture { A } }
    triangle { <-1, -1, -1>, <0, -1, 1>, <0, 1, 0> texture_list { A A B } }
    triangle { <0, -1, 1>, <1, -1, -1>, <0, 1, 0> }
    triangle { <-1, -1, -1>, <1, -1, -1>, <0, -1, 1> texture { B } }
    inside_vector y
    pigment { rgb <0.9, 0.9, 0.2> }
  }
  sphere { <0, 0, -0.6>, 0.6 pigment { rgb 0.9 } }
  scale 1.4 rotate 200*y
}
