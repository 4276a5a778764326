// A half of an isosurface merged with a sphere where the other half was.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -8> look_at 0 }
light_source { <3, 5, -9>, 1 }
background { rgb <0.2, 0.25, 0.3> }
merge {
  sphere { <-1.03, 0.07, 0>, 0.4 }
  intersection {
    isosurface { function { x*x + y*y + z*z - 4 } contained_by { box { -2.1, 2.1 } } max_gradient 6 }
    plane { x, 0.01 inverse }
  }
  pigment { rgb <1, 0.6, 0.3> }
}
