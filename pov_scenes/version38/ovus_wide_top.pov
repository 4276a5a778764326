// An ovus whose top is nearly twice as wide as its bottom has an arc of twice the larger radius.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -7> look_at 0.3*y }
light_source { <5, 8, -6>, 0.8 }
ovus { 0.7, 1.2 }
ovus { 0.7, 0.3 translate 2*x rotate 30*z pigment { rgb <1, 0.7, 0.3> } }
