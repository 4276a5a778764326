// A bicubic patch with an edge drawn together to a point.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 3, -6> look_at <1.5, 1.2, 0> }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
bicubic_patch {
  type 1 u_steps 3 v_steps 3
  <0, 2, 0>, <0, 2, 0>, <0, 2, 0>, <0, 2, 0>,
  <1, 2, 0>, <1, 2, -0.6>, <0.6, 2, -1>, <0, 2, -1>,
  <1.5, 1.5, 0>, <1.5, 1.5, -0.8>, <0.8, 1.5, -1.5>, <0, 1.5, -1.5>,
  <1.5, 0, 0>, <1.5, 0, -0.8>, <0.8, 0, -1.5>, <0, 0, -1.5>
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
  rotate 20*y translate 0.7*x
}
