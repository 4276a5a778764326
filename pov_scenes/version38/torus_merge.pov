// The mode `merge` of a torus that intersects itself, cut open.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
difference { torus { 0.6, 1.1 merge } box { <-3, -3, -3>, <0.3, 3, 0> } pigment { rgb <1, 0.7, 0.3> } }
