// A threshold moves an isosurface; the accuracy shows in its normals.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
isosurface {
  function { sqrt(x*x + y*y + z*z) + 0.1*sin(9*x)*sin(9*y)*sin(9*z) }
  threshold 0.8 accuracy 0.02 max_gradient 2
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
}
