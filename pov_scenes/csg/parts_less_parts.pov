// Twenty parts together less ten others.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.6 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare R = seed(3);
#macro At(S) <rand(R) - 0.5, rand(R) - 0.5, rand(R) - 0.5>*S #end
difference {
  union {
    #for (I, 0, 9)
      sphere { At(2.4), 0.5 pigment { rgb <rand(R), 0.8, rand(R)> } }
      box { -0.4, 0.4 translate At(2.4) pigment { rgb <0.8, rand(R), rand(R)> } }
    #end
  }
  merge {
    #for (I, 0, 4)
      cylinder { At(3), At(3), 0.3 }
      box { -0.2, 0.2 translate At(2.4) pigment { rgb 1 } }
    #end
  }
  rotate <-10, 25, 0>
  pigment { rgb <0.9, 0.6, 0.3> }
}
