// Functions of `user_defined` that are left out give 0.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
background { rgb <0.2, 0.5, 0.3> }
sphere { 0, 1.6 pigment { user_defined { function { 0.5 + 0.3 * x }, , function { abs(z) }, , function { 0.5 + 0.5 * sin(5 * y) } } } }
