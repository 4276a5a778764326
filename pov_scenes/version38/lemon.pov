// A lemon: an arc of a circle turned about the axis between two tips.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
lemon { <0, -1.6, 0>, 0, <0.3, 1.6, 0>, 0, 2.2 pigment { rgb <1, 0.8, 0.1> } finish { phong 0.6 } }
