// A directive between `=` and the value of a declaration runs before the value is read.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare N = 0.5;
#declare N = #declare A = 0.25; N + A;
#local M = #local B = 0.75; #declare C = 0.5; B + C;
#declare Ball = #undef C sphere { 0, N pigment { rgb <M - 0.5, B, A> } }
object { Ball translate -x }
sphere { x, M/2 pigment { #ifdef (C) rgb 1 #else rgb <0.3, 0.5, 0.9> #end } }
