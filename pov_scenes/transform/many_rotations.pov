// A thousand small rotations add up to a whole turn.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Block = box { <-0.7, -0.4, -0.3>, <0.7, 0.4, 0.3> };
#declare Spin = transform { rotate 0 };
#for (I, 1, 1000)
  #declare Spin = transform { Spin rotate 0.36*y };
#end
object { Block transform Spin translate -1.1*x pigment { rgb <0.9, 0.7, 0.3> } }
object { Block translate 1.1*x pigment { rgb <0.9, 0.7, 0.3> } }
