// Lists of points may end with a comma.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#default { pigment { rgb <1, 0.5, 0.2> } }
polygon { 5, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1>, translate -4*x }
prism { 0, 0.5, 4, <-1, -1>, <1, -1>, <0, 1>, <-1, -1>, open translate -2*x }
lathe { linear_spline 4, <0, 0>, <0.8, 0.1>, <0.8, 1>, <0, 1.2>, }
sor { 4, <0.5, -1>, <0.8, -0.5>, <0.5, 0.5>, <0.3, 1>, translate 2*x }
sphere_sweep { linear_spline 2, <0, -1, 0>, 0.3, <0, 1, 0>, 0.5, tolerance 0.01 translate 4*x }
