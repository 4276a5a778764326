// Straight passage through clear sheets uses up no trace level: the seventh sheet still shows the ball behind.
// compare: channel<=2 pixels<=0.15% because "POV-Ray loses sheets that a slanting ray leaves within 1/10000"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#for (I, 0, 6)
  box { <-1.2 + 0.1*I, -0.9, -2 + 0.3*I>, <0.2 + 0.1*I, 0.8, -1.98 + 0.3*I> pigment { rgbt <0.5, 0.7, 0.9, 0.85> } }
#end
sphere { <0, 0, 1.2>, 0.9 pigment { rgb <0.9, 0.4, 0.2> } }
