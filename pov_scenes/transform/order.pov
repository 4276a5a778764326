// Transforms act in the order of the text: turned then moved is not moved then turned.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { -0.5, 0.5 rotate 40*y translate <1.2, -0.4, 0> pigment { rgb <0.9, 0.3, 0.3> } }
box { -0.5, 0.5 translate <1.2, -0.4, 0> rotate 140*y pigment { rgb <0.3, 0.3, 0.9> } }
