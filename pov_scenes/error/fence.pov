// A fence: bars a little wider than a pixel, and their shadows.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.2, -6> look_at 0 angle 40 }
light_source { <-6, 5, -4>, rgb 0.8 }
background { rgb <0.5, 0.6, 0.75> }
plane { y, -1 pigment { rgb <0.4, 0.55, 0.3> } }
#for (I, -30, 30)
  box { <0.09*I - 0.02, -1, -0.01>, <0.09*I + 0.02, 0.7 + 0.1*mod(I + 30, 2), 0.01> pigment { rgb <0.8, 0.78, 0.7> } }
#end
