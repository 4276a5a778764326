// The radius of the arc of an ovus.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0.3*y }
light_source { <5, 8, -6>, 0.8 }
ovus { 1, 0.5 radius 1.6 translate -1.2*x }
ovus { 1, 0.5 radius 8 translate 1.2*x pigment { rgb <1, 0.7, 0.3> } }
