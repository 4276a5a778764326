// inside_vector may stand before and between the triangles of a mesh; the last one counts.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
difference {
  mesh {
    inside_vector x
    triangle { <-1, -1, -1>, <1, -1, -1>, <0, 1, 0> }
    triangle { <1, -1, -1>, <0, -1, 1>, <0, 1, 0> }
    inside_vector y
    triangle { <0, -1, 1>, <-1, -1, -1>, <0, 1, 0> }
    triangle { <-1, -1, -1>, <1, -1, -1>, <0, -1, 1> }
  }
  sphere { <0, 0, -1>, 0.6 }
  pigment { rgb <1, 0.7, 0.3> }
  rotate 20*y
}
