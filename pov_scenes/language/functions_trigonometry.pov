// A curve of balls for each of sin, cos and atan2, in radians, with degrees and radians.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#for (I, 0, 30)
  #declare A = I/30*2*pi;
  sphere { <A/pi*2 - 2, sin(A)*0.7, 0>, 0.08 pigment { rgb <0.9, 0.4, 0.3> } }
  sphere { <A/pi*2 - 2, cos(radians(degrees(A)))*0.7, 0.5>, 0.08 pigment { rgb <0.3, 0.8, 0.4> } }
  sphere { <A/pi*2 - 2, atan2(sin(A), cos(A) + 1e-6)*0.3, 1>, 0.08 pigment { rgb <0.3, 0.4, 0.9> } }
#end
