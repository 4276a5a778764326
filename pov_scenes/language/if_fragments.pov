// A directive may choose a word, a number or half of a statement.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Round = 1;
#if (Round) sphere { <-1, 0, 0>, #else box { <-1, 0, 0>, #end 0.7 pigment { rgb <0.9, #if (Round) 0.3 #else 0.9 #end, 0.3> } }
#if (!Round) intersection { #else merge { #end sphere { <0.8, 0, 0>, 0.5 } sphere { <1.4, 0, 0>, 0.5 } pigment { rgb <0.3, 0.5, 0.9> } }
