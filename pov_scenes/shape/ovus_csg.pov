// Eggs cut, hollowed, sheared and clear.
// compare: channel<=5 pixels<=0.07% because "at the edge of the shadow in the clear egg POV-Ray's own picture changes when the egg is given in other units, which ours does not"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare E = ovus { 0.6, 0.35 }
difference { object { E } object { E scale 0.8 pigment { rgb <0.9, 0.9, 0.3> } } plane { z, -0.1 pigment { rgb <0.9, 0.2, 0.2> } } rotate <-20, 20, 0> translate <-1.6, 0.1, 0> pigment { rgb <0.8, 0.5, 0.2> } }
difference { box { -0.6, 0.6 } object { E scale <1, -1, 0.8> rotate 70*x translate -0.4*z pigment { rgb <0.2, 0.5, 0.8> } } rotate 20*y translate <1.6, 0.2, 0> pigment { rgb <0.5, 0.8, 0.3> } }
object { E matrix <1, 0.4, 0, 0.3, 1, 0, 0, 0, 1, 0, 0.5, 0> pigment { rgb <0.7, 0.3, 0.6> } }
object { E scale 0.7 rotate 60*z translate <0.4, -0.8, -0.9> pigment { rgbf <0.9, 0.9, 1, 0.8> } finish { reflection 0.1 } interior { ior 1.3 } }
