// A glass block shifts what is behind it and reflects totally inside.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-0.9, -0.9, -0.6>, <0.9, 0.8, 0.6> rotate <0, 30, 0> pigment { rgbf <0.95, 1, 0.97, 0.95> } interior { ior 1.5 } }
sphere { <0.2, -0.3, 2>, 0.7 pigment { rgb <0.9, 0.3, 0.2> } }
