// Isosurfaces with all intersections cut and are cut.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
difference {
  isosurface { function { sqrt(x*x + z*z) - 0.6 + 0.1*sin(12*y) } all_intersections max_gradient 2 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } }
  box { <0, -0.2, -2>, <2, 0.5, 2> pigment { rgb <0.2, 0.4, 1> } }
  translate -0.5*x
}
difference {
  box { <0.4, -0.9, -0.5>, <1.4, 0, 0.4> pigment { rgb <0.2, 0.4, 1> } }
  isosurface { function { sqrt(x*x + y*y + z*z) - 0.4 + 0.05*sin(20*y) } max_trace 10 max_gradient 3 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } translate <0.8, -0.2, -0.5> }
}
