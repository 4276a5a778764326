// A gem: what forty half-spaces have in common, one of which only clips.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.6 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare R = seed(9);
intersection {
  #for (I, 0, 38)
    #local Y = 1 - (2*I + 1)/39;
    plane { <sqrt(1 - Y*Y)*cos(2.4*I), Y, sqrt(1 - Y*Y)*sin(2.4*I)>, 1.3 + 0.1*rand(R) pigment { rgb <rand(R), rand(R), 1> } }
  #end
  clipped_by { plane { <1, 1, -1>, 0.9 } }
  rotate 20*y
}
