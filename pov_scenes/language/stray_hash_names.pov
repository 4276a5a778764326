// A `#` before a name that is no number is passed over.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Ball = sphere { 0, 0.8 }
#declare Places = array[2] { <-1.5, 0, 0>, <1.5, 0, 0> }
#declare Red = rgb <0.8, 0.3, 0.3>;
#declare Paint = pigment { color #Red }
#declare Half = function(a) { #a/2 };
#macro At(Place) translate #Place #end
object { #Ball pigment { #Paint } At(Places[0]) }
object { # // also so
  Ball pigment { Paint } #At(1.5*x) }
sphere { #
  y, #Half(1) pigment { rgb 0.8 } }
