// An ovus whose arc is centred on the axis is a sphere.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -9> look_at 0.3*y }
light_source { <5, 8, -6>, 0.8 }
ovus { 0.5, 0.25 distance 1 radius 0.875 translate -2*x }
ovus { 0.5, 1 translate <2, -1, 0> pigment { rgb <1, 0.7, 0.3> } }
