// A `#while` loop, and one inside another that ends by `#break`.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare I = 0;
#while (I < 6)
  #declare J = 0;
  #while (1)
    sphere { <I*0.7 - 1.75, J*0.35 - 0.8, 0>, 0.16 pigment { rgb <0.15*I, 0.5, 1 - 0.2*J> } }
    #declare J = J + 1;
    #if (J > I) #break #end
  #end
  #declare I = I + 1;
#end
