// A texture_list gives the corners of a triangle textures, which are mixed between them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <3, 5, -9> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare A = texture { pigment { rgb <1, 0.2, 0.1> } finish { phong 0.6 } }
#declare B = texture { pigment { checker rgb 1, rgb <0, 0.4, 0> scale 0.3 } }
#declare C = texture { pigment { rgb <0, 0.2, 1> } finish { reflection 0.4 ambient 0.3 } }
plane { y, -1.2 pigment { checker rgb 1, rgb 0.5 } }
mesh {
  triangle { <-2, -1, 0>, <2, -1, 0>, <-1, 1.5, 0.5> texture_list { A B C } }
  triangle { <2, -1, 0>, <-1, 1.5, 0.5>, <2, 1.5, 0> texture_list { B, C, A } }
  rotate 10*x
}
