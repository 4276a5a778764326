// Optional arguments may come first, and all may be left out.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Ball(optional At, optional R)
  #ifndef (local.At) #local At = <0, -1, 0>; #end
  #ifndef (local.R) #local R = 0.4; #end
  sphere { At, R pigment { rgb <1, 0.5, 0.2> } }
#end
Ball(, 0.8)
Ball(2*x, )
Ball(, )
Ball(-2*x, 0.6)
