// The distance of the spheres of an ovus.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0.3*y }
light_source { <5, 8, -6>, 0.8 }
ovus { 0.8, 0.6 distance 1.2 radius 2.4 precision 1e-5 sturm translate -1.2*x }
ovus { 0.8, 0.4 distance 1.3 translate 1.2*x pigment { rgb <1, 0.7, 0.3> } }
