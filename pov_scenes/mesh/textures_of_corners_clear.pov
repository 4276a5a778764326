// Textures mixed between the corners of a triangle let light through in their shares, and shadows too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <3, 5, -9> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare A = texture { pigment { rgbt <1, 0.2, 0.1, 0.9> } }
#declare B = texture { pigment { rgbf <0.2, 1, 0.3, 0.8> } finish { reflection 0.2 } }
#declare C = texture { pigment { rgb <0, 0.2, 1> } }
plane { y, -1.2 pigment { checker rgb 1, rgb 0.5 } }
mesh {
  triangle { <-2, -1, 0>, <2, -1, 0>, <-1, 1.5, 0.5> texture_list { A B C } }
  triangle { <2, -1, 0>, <-1, 1.5, 0.5>, <2, 1.5, 0> texture_list { B, C, A } }
}
