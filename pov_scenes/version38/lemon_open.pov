// An open lemon without caps shows its interior_texture.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
lemon { <0, -1, 0>, 0.8, <0.2, 1, 0>, 0.9, 2.5 open texture { pigment { rgb <0, 0, 1> } } interior_texture { pigment { rgb <1, 1, 0> } } }
