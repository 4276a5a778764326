// A macro stands for its body; arguments are used in it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Lamp(Place, Size, Tint)
  union { sphere { 0, Size } cylinder { 0, -2*Size*y, Size/4 } pigment { rgb Tint } translate Place }
#end
Lamp(<-1.4, 0.4, 0>, 0.4, <0.9, 0.4, 0.3>)
Lamp(<0, 0.2, 0>, 0.3, <0.4, 0.9, 0.3>)
object { Lamp(0, 0.5, <0.3, 0.4, 0.9>) rotate 40*z translate <1.3, 0.2, 0> }
