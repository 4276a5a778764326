// Half-spaces that touch enclose a plate without thickness, which shows.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -6> look_at 0 angle 40 }
light_source { <4, 6, -6>, 1 }
background { rgb <.2, .3, .5> }
intersection { plane { y, -.5 } plane { -y, .5 } sphere { <0, -.5, 0>, 1.5 } pigment { rgb <1, .3, .2> } }
intersection {
  plane { y, 0 } plane { y, 0 inverse } cylinder { -y, y, .6 }
  pigment { rgb <.3, .8, .4> } rotate <50, 30, 0> translate <0, 1, .5>
}
