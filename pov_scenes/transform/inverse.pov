// `inverse` in a transform block undoes all of it, wherever it stands in the block.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Move = transform { scale <2, 1, 0.5> rotate <20, 40, 60> translate <0.5, 0.2, -0.3> };
box { -0.5, 0.5 transform { Move } transform { Move inverse } translate -1.2*x pigment { rgb <0.8, 0.8, 0.3> } }
box { -0.5, 0.5 transform { inverse rotate 30*y translate 1.3*z } translate <1.5, 0, 1> pigment { rgb <0.3, 0.8, 0.8> } }
