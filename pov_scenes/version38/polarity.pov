// A positive `polarity` of an isosurface puts its inside where the function is above the threshold.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare F = function { 1 - sqrt(x*x + y*y + z*z) + 0.1 * sin(10 * x) }
difference { isosurface { function { F(x, y, z) } threshold 0 polarity on contained_by { box { -1.3, 1.3 } } max_gradient 3 all_intersections } box { <0, 0, -2>, 2 } translate -1.5*x }
isosurface { function { -F(x, y, z) } polarity -1 contained_by { box { -1.3, 1.3 } } max_gradient 3 translate 1.5*x pigment { rgb <1, 0.5, 0.2> } }
