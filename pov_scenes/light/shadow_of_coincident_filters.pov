// Shadows of coincident filters that no camera ray sees: the one that is nearer to the last bit colours the light.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <4.5, 5, -4.5> look_at 0 angle 60 }
light_source { <-6, 3.5, 3> rgb 1.5 }
plane { y, 0 pigment { checker rgb 1, rgb 0.5 } }
plane { x, -8 pigment { rgb 0.8 } }
cylinder { 0.3*y, 3*y, 0.94 pigment { rgbf <0.6, 1, 0.7, 0.9> } no_image }
cylinder { 0.3*y, 2.4*y, 0.94 pigment { rgbf <1, 0.5, 0, 0.8> } no_image }
