// An isosurface cuts by its function at the points of the others, whatever `max_gradient` is.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 10, -10> look_at 0 right 4*x up 3*y }
light_source { <3, 10, -5>, 1 }
#declare Wavy = isosurface {
  function { 3*y + 0.5*sin(6*x)*cos(5*z) }
  threshold 0.2
  max_gradient 1.1
  contained_by { sphere { 0, 1.3 } }
}
sphere { 0, 0.9 clipped_by { Wavy } pigment { rgb <1, 0.5, 0.2> } translate -x }
difference {
  box { <-0.7, -0.6, -0.7>, <0.7, 0.6, 0.7> }
  object { Wavy }
  pigment { rgb <0.3, 0.6, 1> }
  translate x
}
