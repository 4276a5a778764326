// `slope` towards a point: the vector to the hit point is made a unit vector, the difference of both is not.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> look_at 0 }
sphere {
  <-0.7, 0, 0>, 0.6
  pigment { slope { point_at <-1, 0.9, -0.6> } color_map { [0 rgb 0] [0.5 rgb <1, 0.5, 0>] [1 rgb 1] } }
  finish { emission 1 diffuse 0 }
}
sphere {
  <0.7, 0, 0>, 0.6
  pigment { slope { point_at <1, 0.7, -0.6>, 0.3, 0.8 } color_map { [0 rgb 0] [0.5 rgb <0, 0.5, 1>] [1 rgb 1] } }
  finish { emission 1 diffuse 0 }
}
