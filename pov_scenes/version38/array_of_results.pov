// An item of a local array gets the result of a macro that is no number; the macro's own names are gone by then.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Size(R)
  #local Sizes = dictionary { .ball: R };
  #declare Sizes.height = R/2;
  Sizes
#end
#macro Balls()
  #local Sizes = array;
  #local Sizes[0] = Size(0.6);
  #local Sizes[1] = Size(0.9);
  #for (I, 0, 1)
    sphere { <3*I - 1.5, Sizes[I].height, 0>, Sizes[I].ball pigment { rgb <1, I, 0.3> } }
  #end
#end
Balls()
