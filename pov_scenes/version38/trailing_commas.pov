// A matrix and a bicubic patch may end with a comma.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 matrix <1, 0.3, 0, 0, 1, 0, 0, 0, 1, -1.5, 0, 0,> pigment { rgb <1, 0.5, 0.2> } }
bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3
  <0,0,0>, <1,0,1>, <2,0,1>, <3,0,0>, <0,1,1>, <1,1,-2>, <2,1,2>, <3,1,1>, <0,2,1>, <1,2,2>, <2,2,2>, <3,2,1>, <0,3,0>, <1,3,1>, <2,3,1>, <3,3,0>,
  translate <0, -1, 0> scale 0.8 }
