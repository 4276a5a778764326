// Smooth triangles in a mesh shade by the mean of the normals, and flat if all three are equal.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
mesh {
  smooth_triangle { <-1.8, -0.7, 0>, <-1, -1, -2>, <-0.2, -0.7, 0>, <1, -1, -2>, <-1, 1, 0>, <0, 1, -2> }
  smooth_triangle { <0.2, -0.7, 0>, <-1, 0, -1>, <1.8, -0.7, 0>, <-1, 0, -1>, <1, 1, 0>, <-1, 0, -1> }
  pigment { rgb <0.4, 0.6, 0.9> }
  finish { specular 0.6 roughness 0.03 }
}
