// Level rings of lathes flush with the tops of boxes: roundings decide which shows.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 2.3, -4.4> look_at 0.2*y angle 42 }
light_source { <20, 40, -30>, 1 }
background { rgb <0.4, 0.5, 0.7> }
plane { y, 0 pigment { rgb 0.5 } }
box { <0.1, 0, -1>, <2, 0.2, 1.3> pigment { rgb <0.9, 0.8, 0.2> } }
box { <-2, 0, -1>, <-0.1, 0.3, 1.3> pigment { rgb <0.9, 0.8, 0.2> } }
lathe { linear_spline 4, <0, -0.1>, <0.5, 0>, <0.7, 0.2>, <0, 0.2> translate 1.1*x pigment { rgb <0.2, 0.3, 0.9> } }
lathe { bezier_spline 8, <0.2, 0>, <0.5, 0.1>, <0.6, 0.2>, <0.7, 0.3>, <0.7, 0.3>, <0.5, 0.3>, <0.3, 0.3>, <0, 0.3>
  translate -1.1*x pigment { rgb <0.2, 0.3, 0.9> } }
