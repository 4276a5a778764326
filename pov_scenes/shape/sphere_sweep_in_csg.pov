// A sphere sweep cut by a box, and cut from one.
// compare: channel<=40 pixels<=0.2% because "POV-Ray shows walls inside the sweep where two pieces meet"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -5> look_at 0 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
difference { sphere_sweep { linear_spline 6, <-2, 0, 0>, 0.5, <-1, 1, 0>, 0.4, <0, -1, 0.5>, 0.6, <1, 1, -0.5>, 0.2, <2, 0, 0>, 0.5, <2, 1, 2>, 0.3 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } } box { <-3, -3, -3>, <3, 0, 0.1> pigment { rgb <0.2, 0.4, 1> } } translate 0.7*y }
difference { box { <-2.2, -1.6, -0.3>, <2.2, -0.2, 0.6> pigment { rgb <0.2, 0.4, 1> } } sphere_sweep { b_spline 4, <-4, 0, 0>, 0.5, <-1, 1, 0>, 0.4, <1, -1, 0>, 0.6, <4, 1, -0.5>, 0.4 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } scale 0.8 translate <0, -0.7, -0.4> } rotate -10*x }
