// The mode `merge` of a torus that intersects itself, transparent, with an interior_texture.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { y, -1.5 pigment { checker rgb 1 rgb <0.2, 0.6, 0.3> } }
torus { 0.7, 1 merge texture { pigment { rgbt <1, 0.3, 0.3, 0.6> } } interior_texture { pigment { rgbt <0.2, 0.3, 1, 0.6> } } rotate 20*x }
