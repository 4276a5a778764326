// Version 3.71 has the words of 3.8, but the defaults of 3.7.
#version 3.71;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, tau / 6 }
sphere { x, 0.8 pigment { rgb <1, 0.5, 0.2> } }
