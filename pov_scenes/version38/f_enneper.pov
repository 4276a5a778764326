// The function f_enneper.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -12> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare f_enneper = function { internal(18) }
isosurface { function { f_enneper(x, y, z, 1) } threshold 0 contained_by { box { -2, 2 } } max_gradient 900 all_intersections pigment { rgb <1, 0.7, 0.3> } }
