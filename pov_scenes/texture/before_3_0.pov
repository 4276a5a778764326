// Before version 3.0 the words of pigment, normal and finish stand in the texture itself, in any order; transformations move what has
// been read; turbulence is of the pigment; marble and wood have a ramp wave; a bare number is crand.
#version 2.0;
camera { location <0, 0, -8> look_at <0, 0, 0> angle 44 }
light_source { <5, 8, -6> color red 1 green 1 blue 1 }
#declare Rust = color red 0.8 green 0.4
#declare Veined = texture { marble color_map { [0 color red 1 green 1] [1 color blue 0.6] } turbulence 0.4 phong 1 }
#declare Shell = texture { bozo scale 0.3 }
#default { texture { ambient 0.2 } }
sphere { <-2.2, 1.8, 0>, 0.7 texture { Veined scale 0.5 } }
sphere { <-0.7, 1.8, 0>, 0.7 texture { color blue 1 color_map { [0 color red 1] [1 color green 1] } scale 2 bumps 0.5 scale 0.2 ambient 0.3 } }
sphere { <0.7, 1.8, 0>, 0.7 texture { wood color_map { [0 color red 1] [1 color green 1] } scale 0.3 specular 0.6 roughness 0.02 metallic } }
sphere { <2.2, 1.8, 0>, 0.7 texture { checker color red 1 color Rust scale 0.3 diffuse 0.9 reflection 0.2 } }
sphere { <-2.2, 0, 0>, 0.7 texture { Shell color_map { [0 color red 1] [1 color green 1 blue 1] } dents 0.7 scale 0.5 } }
sphere { <-0.7, 0, 0>, 0.7 texture { waves 0.6 frequency 5 phase 0.3 scale 0.3 Rust brilliance 2 } }
sphere { <0.7, 0, 0>, 0.7 texture { bozo bumps 0.4 turbulence 0.8 octaves 3 scale 0.4 quick_color green 1 } }
sphere { <2.2, 0, 0>, 0.7 texture { pigment { granite scale 0.4 } color_map { [0 color red 1] [1 color green 1] } finish { phong 0.6 } } }
sphere { <-2.2, -1.8, 0>, 0.7 texture { tiles { texture { Rust phong 1 } tile2 texture { leopard scale 0.1 } } scale 0.4 } }
sphere { <-0.7, -1.8, 0>, 0.7 texture { color red 1 alpha 0.7 ior 1.2 refraction 1 phong 1 } }
sphere { <0.7, -1.8, 0>, 0.7
  texture { onion color_map { [0 color red 0.4] [1 color green 1] } scale 0.2 }
  texture { gradient <1, 0, 0> color_map { [0 color red 1 alpha 1] [1 color blue 1 alpha 0.3] } scale 0.3 ripples 0.3 scale 0.4 } }
sphere { <2.2, -1.8, 0>, 0.7 texture { hexagon color red 1 color green 1 color blue 1 scale 0.2 rotate 90*x wrinkles 0.6 } }
