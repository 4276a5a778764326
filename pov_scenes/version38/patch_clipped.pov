// Bicubic patches are clipped like any shape.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 0.2, -6> look_at 0 angle 40 }
light_source { <5, 8, -9>, 1 }
#declare Patch = bicubic_patch { type 1 u_steps 3 v_steps 3 flatness 0.01
  <-1, -1, -0.2>, <-1, -0.3, -0.2>, <-1, 0.3, 0.5>, <-1, 1, 0>, <-0.3, -1, 0.2>, <-0.3, -0.3, -0.1>, <-0.3, 0.3, 0>,
  <-0.3, 1, 0.6>, <0.3, -1, -0.3>, <0.3, -0.3, 0>, <0.3, 0.3, 0>, <0.3, 1, -0.5>, <1, -1, -0.5>, <1, -0.3, 0>,
  <1, 0.3, 0.4>, <1, 1, -0.1>
  pigment { rgb <1, 0.4, 0.2> } }
object { Patch clipped_by { sphere { 0, 0.6 } } translate -1.2*x }
object { Patch clipped_by { sphere { 0, 0.6 } plane { x, 0.3 } } rotate 20*z translate 1.2*x }
