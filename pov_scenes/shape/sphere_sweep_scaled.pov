// A sphere sweep scaled unevenly, with its mirror image.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -5> look_at 0 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
plane { y, -1.2 pigment { rgb 0.3 } finish { reflection 0.6 } }
sphere_sweep { b_spline 6, <-2, 0, 0>, 0.5, <-1, 1, 0>, 0.4, <0, -1, 0.5>, 0.6, <1, 1, -0.5>, 0.2, <2, 0, 0>, 0.5, <2, 1, 2>, 0.3 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } scale <1.4, 0.6, 2> rotate <30, 10, -20> }
