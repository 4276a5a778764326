// A sphere has a centre and a radius.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> look_at 0 }
light_source { <5, 8, -10>, rgb 1 }
sphere { <0.3, 0, 0>, 1 pigment { rgb <0.8, 0.3, 0.2> } }
