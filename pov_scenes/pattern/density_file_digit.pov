// `interpolate` of a `density_file`: the last digit counts, and all but 0 and 1 are 2.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <2, 1.5, -5> right 4*x up 3*y }
light_source { <-4, 6, -8>, rgb 1 }
#macro Face(N) pigment { density_file df3 "densities/bytes.df3" interpolate N } finish { ambient 1 diffuse 0 } #end
box { <0, 0, 0.3>, <1, 1, 1> Face(10) translate <0.3, 0.2, 0> }
box { <0, 0, 0.3>, <1, 1, 1> Face(21.5) translate <1.5, 0.2, 0> }
box { <0, 0, 0.3>, <1, 1, 1> Face(3) translate <2.7, 0.2, 0> }
box { <0, 0, 0.3>, <1, 1, 1> Face(12) translate <0.3, 1.5, 0> }
box { <0, 0, 0.3>, <1, 1, 1> Face(255) translate <1.5, 1.5, 0> }
box { <0, 0, 0.3>, <1, 1, 1> Face(-1) translate <2.7, 1.5, 0> }
