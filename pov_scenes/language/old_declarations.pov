// Before 3.5 a declaration needs no semicolon.
#version 3.1;
#declare Size = 0.8
#declare Paint = color red 0.9 green 0.6
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, Size pigment { Paint } }
