// `#switch` with cases, ranges, falling through without `#break`, and `#else`.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#for (I, 0, 5)
  #declare H = 0;
  #switch (I)
    #case (0) #declare H = 0.2; #break
    #case (1) #declare H = H + 0.3;
    #case (2) #declare H = H + 0.4; #break
    #range (3, 4) #declare H = 0.9; #break
    #else #declare H = 1.1;
  #end
  cylinder { <I*0.7 - 1.75, -0.9, 0>, <I*0.7 - 1.75, -0.9 + H, 0>, 0.25 pigment { rgb <0.9, 0.15*I, 0.4> } }
#end
