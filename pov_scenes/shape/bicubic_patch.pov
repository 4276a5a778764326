// A bicubic patch of type 0 in its usual steps.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 3, -6> look_at <1.5, 1.2, 0> }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
bicubic_patch {
  type 0 u_steps 3 v_steps 3 flatness 0.01
  <0, 0, 2>, <1, 0, 0>, <2, 0, 0>, <3, 0, -2>,
  <0, 1, 0>, <1, 1, -2>, <2, 1, 0>, <3, 1, 0>,
  <0, 2, 0>, <1, 2, 0>, <2, 2, 1>, <3, 2, 0>,
  <0, 3, 2>, <1, 3, 0>, <2, 3, 0>, <3, 3, -2>
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
}
