// Mirroring in all three axes keeps the blended normals of a smooth triangle right.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Petal = smooth_triangle {
  <0.2, -0.8, 0>, <-0.5, -0.4, -1>, <1.8, -0.6, 0>, <0.7, -0.3, -1>, <0.8, 1, 0>, <0, 0.8, -1>
  pigment { rgb <0.9, 0.5, 0.6> } finish { phong 0.8 }
};
object { Petal }
object { Petal scale -1 rotate 180*x }
