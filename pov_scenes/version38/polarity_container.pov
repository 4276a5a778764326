// With `polarity on` the cross-section with the container closes the part above the threshold.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
isosurface { function { y + 0.2 * sin(6 * x) } polarity on contained_by { sphere { 0, 1.2 } } max_gradient 2.5 translate -1.5*x }
isosurface { function { y + 0.2 * sin(6 * x) } polarity off contained_by { sphere { 0, 1.2 } } max_gradient 2.5 translate 1.5*x pigment { rgb <1, 0.5, 0.2> } }
