// Tuples without some of the names, whose values may lack as well.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Sides(Radius, optional Tint) (Radius, local.Tint) #end
#declare (R, ) = Sides(1.2, );
#declare (, Red, , Green) = (1, 0.8, "unused", 0.3);
#declare (S, ) = (0.4, sphere { 0, 1 });
#declare () = ();
sphere { 0, R pigment { rgb <Red, Green, 0.2> } }
box { <1.4, -S, -S>, <1.4 + S, S, S> pigment { rgb <Green, Red, 0.9> } }
