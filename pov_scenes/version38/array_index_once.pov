// The index of an item of a mixed array is computed once: the macro in it counts its calls.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare Calls = 0;
#macro Next() #declare Calls = Calls + 1; mod(Calls, 3) #end
#macro Ball(At, optional Size) sphere { <At, 1.2, 0>, 0.2 + 0.1*Calls/8 pigment { rgb <0.9, 0.5, 0.2> } } #end
#declare Numbers = array mixed [3] { 1, 2, 3 };
#declare Shapes = array mixed [3] { sphere { 0, 0.5 }, box { -0.4, 0.4 }, cone { -0.5*y, 0.5, 0.5*y, 0 } };
#declare Colours = array mixed [3] { rgb <1, 0.2, 0.2>, rgb <0.2, 1, 0.2>, rgb <0.2, 0.2, 1> };
#declare Stream = seed(7);
object { Shapes[Next()] scale Numbers[Next()]/2 translate <-2, 0, 0> pigment { Colours[Next()] } }
union { object { Shapes[Next()] } translate <-0.5*Numbers[Next()], 0, 0> pigment { Colours[Next()] } }
sphere { <Numbers[Next()] - 1, -1.2, 0>, 0.3*Numbers[Next()] pigment { rgb Numbers[Next()]/3 } }
Ball(Numbers[Next()]/2 - 2.2, Numbers[Next()] + 1)
Ball(Numbers[Next()]/2, )
#declare Value = Numbers[floor(rand(Stream)*3)] + 1;
sphere { <1.8, 0, 0>, 0.2 + 0.6*rand(Stream) pigment { Colours[mod(Calls, 3)] } }
