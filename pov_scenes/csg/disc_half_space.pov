// In solid geometry a disc is the half-space behind its normal, whatever its radius, but only its circle is surface.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference { sphere { 0, 0.9 } disc { 0, <0, -1, 0.7>, 0.5 } translate -1.1*x pigment { rgb <0.9, 0.7, 0.3> } }
difference { sphere { 0, 0.9 } disc { 0.2*y, <0, -1, 0.5>, 2 } translate 1.1*x pigment { rgb <0.5, 0.8, 0.3> } }
