// cutaway_textures in and around other combinations: the outermost one that is no union gathers, and unions do not heed the word.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { pigment { rgb <0.05, 0.15, 0.25> } finish { ambient 0.6 } }
camera { orthographic location <0, 0, -10> look_at 0 right 8 * x up 6 * y }
light_source { <-10, 20, -30> rgb 0.6 }
#declare Red = pigment { rgb <1, 0.2, 0.1> }
#declare Green = pigment { rgb <0.1, 1, 0.2> }
#declare Open = difference { box { -1, 1 pigment { Red } } box { <-0.6, -0.6, -2>, <0.6, 0.6, -0.5> } cutaway_textures }
#declare Lid = intersection { box { <-1, -1, -0.8>, <1, 1, 1> } box { -1.4, 1.4 pigment { Green } } cutaway_textures }
union { object { Open } sphere { <0.5, 0.5, 0>, 0.7 } translate <-2.7, 1.5, 0> }
difference { object { Open } box { <-0.4, -0.4, -2>, <0.4, 0.4, 0> } translate <0, 1.5, 0> }
difference { object { Open } box { <-0.4, -0.4, -2>, <0.4, 0.4, 0> } cutaway_textures translate <2.7, 1.5, 0> }
intersection { object { Lid } box { -1.2, 1.2 pigment { Red } } translate <-2.7, -1.5, 0> }
difference { box { -1.2, 1.2 pigment { Red } } object { Lid translate -0.6 * z } translate <0, -1.5, 0> }
intersection {
  box { -1.2, 1.2 pigment { Red } }
  union { box { <-1, -1, -0.8>, <0, 0, 1> } sphere { 0.4, 0.6 } }
  cutaway_textures
  translate <2.7, -1.5, 0>
}
