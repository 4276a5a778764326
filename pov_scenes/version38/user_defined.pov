// `user_defined` takes a function for each component of the colour.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1.6 pigment { user_defined { function { 0.5 + 0.3 * x }, function { 0.5 + 0.5 * sin(6 * y) }, function { abs(z) } } } }
