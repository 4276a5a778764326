// One sphere of a linear sweep holds its neighbour.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -5> look_at 0 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
sphere_sweep { linear_spline 3, <-1, 0, 0>, 1, <-0.8, 0, 0>, 0.2, <1.5, 0.2, 0>, 0.4 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } }
