// The first and the last point of a lathe may lie beyond its axis.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 1.2, -4> look_at 0 angle 50 }
light_source { <3, 5, -6> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare Finish = texture { pigment { rgb <1, 0.7, 0.3> } }
lathe { linear_spline 3, <-0.5, -1>, <1, 0>, <0.5, 1> texture { Finish } scale 0.5 translate -x }
lathe { linear_spline 3, <0.5, -1>, <1, 0>, <-0.5, 1> texture { Finish } scale 0.5 translate 0.6*x }
