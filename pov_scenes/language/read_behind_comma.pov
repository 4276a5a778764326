// Name that is declared without a value: #read takes it behind the last comma of a file, and of an empty one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 1 }
#macro Written (Text)
  #fopen Out "read_behind_comma.txt" write
  #write (Out, Text)
  #fclose Out
#end
Written ("1, 2")
#fopen In "read_behind_comma.txt" read
#read (In, A, B, C)
#ifdef (C) sphere { -1.5*x, 0.5 pigment { rgb <1, 0.7, 0> } } #else box { -0.4, 0.4 translate -1.5*x pigment { rgb <0, 0.5, 1> } } #end
Written ("1, 2,")
#fopen In "read_behind_comma.txt" read
#read (In, A, B, D, E)
#ifdef (D) sphere { 0, 0.5 pigment { rgb <1, 0.7, 0> } } #else box { -0.4, 0.4 pigment { rgb <0, 0.5, 1> } } #end
#ifdef (E) sphere { 1.5*x, 0.5 pigment { rgb <1, 0.7, 0> } } #else box { -0.4, 0.4 translate 1.5*x pigment { rgb <0, 0.5, 1> } } #end
Written ("")
#fopen In "read_behind_comma.txt" read
#read (In, F)
#ifdef (F) sphere { 2*z, 0.5 pigment { rgb <1, 0.7, 0> } } #else box { -0.4, 0.4 translate 2*z pigment { rgb <0, 0.5, 1> } } #end
#ifndef (In) cylinder { -y, -0.8*y, 2 pigment { rgb 1 } } #end
