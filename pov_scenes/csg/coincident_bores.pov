// Bores and pits that end flush with the surface of a solid stay closed there: coincident faces leave a skin.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 5, -9> look_at 0 angle 40 }
light_source { <4, 8, -6>, 1 }
background { rgb <.2, .3, .5> }
#declare Bores = union {
  difference { box { -1, 1 } cylinder { -y, y, .5 } translate -2.4*x }
  difference { cylinder { -y, y, 1 } cylinder { -y, y, .6 } }
  difference { box { -1, 1 } box { <-.5, -.5, -.5>, <.5, 1, .5> } translate 2.4*x }
}
object { Bores pigment { rgb <1, .5, .2> } scale .8 translate 1.6*z }
object { Bores pigment { rgb <.4, .8, .3> } scale .7 rotate <40, 15, 10> translate <0, -.6, -2> }
