// Without flatness a bicubic patch is halved as usual also where the first corner of its other edge is drawn to a point.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2.5, -6> look_at <0, 0.5, 0> angle 40 }
light_source { <-5, 10, -8>, 1 }
plane { y, -0.5 pigment { checker rgb 0.4 rgb 0.8 } }
bicubic_patch {
  type 0 u_steps 5 v_steps 3
  <0, 1, 0>, <0.1, 1, 0>, <0.1, 1, 0.1>, <0, 1, 0.1>
  <0, 1, 0>, <0.5, 0.8, 0>, <0.5, 0.8, 0.5>, <0, 0.8, 0.5>
  <0, 1, 0>, <0.8, 0.4, 0>, <0.8, 0.4, 0.8>, <0, 0.4, 0.8>
  <0, 1, 0>, <1, 0, 0>, <1, 0, 1>, <0, 0, 1>
  pigment { rgb <0.8, 0.5, 0.3> } finish { specular 0.3 }
  scale 1.2 rotate 130*y
}
