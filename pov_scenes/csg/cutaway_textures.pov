// cutaway_textures: what has no texture looks like what it cuts, all that is there with the same weight.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { pigment { rgb <0.6, 0.5, 0.1> } }
camera { location <1, 4, -8> look_at <0, 0, 0> angle 42 }
light_source { <-10, 20, -20> rgb 1 }
difference {
  union {
    sphere { <-2, 0, 0>, 1.2 pigment { checker rgb <1, 0.2, 0.2> rgb 1 scale 0.3 } finish { phong 0.8 } }
    sphere { <-1, 0, 0>, 1 texture { pigment { rgb <0.1, 0.3, 1> } normal { bumps 0.6 scale 0.1 } } }
    merge {
      cylinder { <-2.5, -0.3, 0>, <0.6, -0.3, 0>, 0.3 }
      cylinder { <-2.5, 0.3, 0>, <0.6, 0.3, 0>, 0.3 }
      pigment { rgb <0.1, 0.8, 0.2> }
    }
  }
  box { <-4, 0.1, -3>, <2, 3, -0.1> rotate -10 * x }
  sphere { <-2.2, -0.6, -1.2>, 0.6 pigment { rgb 0.9 } }
  cutaway_textures
}
intersection {
  box { -1, 1 pigment { gradient x color_map { [0 rgb 0] [1 rgb <1, 0.5, 0>] } scale 0.5 } }
  object { union { sphere { 0, 1.3 } plane { -y, -5 } } }
  sphere { <0.3, 0, 0>, 1.4 pigment { rgbt <0.2, 0.9, 1, 0.4> } interior { ior 1.3 } }
  plane { z, 0.5 }
  plane { -z, 0.4 rotate 20 * y }
  cutaway_textures
  rotate 30 * y
  translate <2.2, -0.3, 0>
}
intersection { sphere { <0, 1.6, 1>, 0.7 } plane { y, 1.8 } cutaway_textures }
difference { box { -0.5, 0.5 pigment { rgb 1 } } sphere { -z * 0.5, 0.4 } cutaway_textures pigment { rgb <1, 0, 1> } translate <0.5, -1, -2> }
plane { y, -1.6 pigment { rgb 0.7 } }
