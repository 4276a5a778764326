// The words of 3.8 are free names in a scene of version 3.7.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 pigment { rgb <0.2, 0.5, 1> } }
