// Before version 3.0 a bare number in a texture is its crand.
#version 2.0;
camera { location <0, 0, -4> look_at <0, 0, 0> }
light_source { <5, 8, -6> color red 1 green 1 blue 1 }
sphere { <0, 0, 0>, 1.2 texture { color red 1 green 0.7 0.3 phong 0.5 } }
