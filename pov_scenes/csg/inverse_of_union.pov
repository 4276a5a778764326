// Taking away a union is taking away each of its members; an inverse union does the same.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Holes = union {
  cylinder { <-3, 0, 0>, <3, 0, 0>, 0.35 }
  cylinder { <0, -3, 0>, <0, 3, 0>, 0.35 }
  cylinder { <0, 0, -3>, <0, 0, 3>, 0.35 }
};
difference { sphere { 0, 0.9 } object { Holes } rotate <20, 30, 0> translate -1.1*x pigment { rgb <0.9, 0.7, 0.3> } }
intersection { sphere { 0, 0.9 } object { Holes inverse } rotate <20, 30, 0> translate 1.1*x pigment { rgb <0.3, 0.7, 0.9> } }
