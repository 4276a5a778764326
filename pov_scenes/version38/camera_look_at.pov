// The last digits of an aslant `look_at`: a fractal fills its bounding sphere, where they decide if a ray begins inside.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 angle 40 }
light_source { <5, 8, -6>, 1 }
julia_fractal { <-0.4, 0.3, 0.1, 0.1> hypercomplex reciprocal max_iteration 4 precision 15 pigment { rgb <1, 0.8, 0.5> } }
