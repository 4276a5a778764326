// An inner radius that is too small is replaced by that of a sphere about a point of the axis.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -7> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
lemon { <0, -1, 0>, 1.2, <0, 1.3, 0>, 0.5, 1 pigment { rgb <0.9, 0.6, 0.1> } rotate 20*z }
