// An isosurface of positive polarity taken from a box.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
difference { box { -1.4, 1.4 } isosurface { function { 1 - (x*x + y*y + z*z) } polarity 1 threshold 0 max_gradient 4 contained_by { box { -1.2, 1.2 } } translate <0.6, 0.6, -0.9> } pigment { rgb <0.8, 0.6, 0.5> } rotate 20*y }
