// doubts in line 3: a spherical camera before version 3.5
#version 3.1;
camera { spherical location -5*z }
sphere { 0, 1 pigment { color rgb 1 } }
light_source { <4, 6, -8>, rgb 1 }
