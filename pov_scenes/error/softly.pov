// The soft shadows of a lamp with a surface.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2.6, -6> look_at <0, 0.3, 0> angle 42 }
light_source { <-3, 5, -3>, rgb 0.8 area_light 1.5*x, 1.5*z, 5, 5 adaptive 1 }
background { rgb <0.5, 0.6, 0.75> }
plane { y, -0.5 pigment { rgb <0.75, 0.7, 0.62> } finish { ambient 0.1 diffuse 0.75 } }
box { <-1.6, -0.5, -0.4>, <-0.7, 0.7, 0.5> rotate 15*y pigment { rgb <0.7, 0.3, 0.2> } finish { ambient 0.1 diffuse 0.7 } }
sphere { <0.35, 0.1, -0.3>, 0.6 pigment { rgb <0.25, 0.45, 0.7> } finish { ambient 0.1 diffuse 0.7 specular 0.3 } }
cone { <1.6, -0.5, 0.3>, 0.5, <1.6, 1.1, 0.3>, 0.1 pigment { rgb <0.4, 0.6, 0.3> } finish { ambient 0.1 diffuse 0.7 } }
