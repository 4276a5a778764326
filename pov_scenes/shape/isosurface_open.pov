// An open isosurface in a ball has no walls.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
isosurface {
  function { x*x + y*y*y - z*z - 0.3 }
  contained_by { sphere { 0, 1.3 } } open
  max_gradient 6
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
}
