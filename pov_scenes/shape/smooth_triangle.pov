// A smooth triangle blends the normals of its corners.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
smooth_triangle {
  <-1.6, -0.8, 0>, <-0.8, -0.6, -1>
  <1.6, -0.8, 0>, <0.8, -0.6, -1>
  <0, 1.2, 0>, <0, 0.9, -1>
  pigment { rgb <0.8, 0.7, 0.3> }
  finish { phong 0.7 phong_size 30 }
}
