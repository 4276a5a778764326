// Keys of `global` and `local` that are computed stand for a name wherever it may stand, but a macro's argument is a copy.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -8> look_at <0, 0.7, 0> angle 50 }
light_source { <5, 8, -6>, 0.8 }
#for (I, 0, 4)
  #declare global[concat("Height", str(I, 0, 0))] = 0.4 * I + 0.3;
#end
#declare Kinds = array[3] { "Red", "Green", "Blue" }
#declare Red = pigment { rgb <0.9, 0.2, 0.2> }
#declare Green = pigment { checker rgb <0.2, 0.8, 0.2> rgb 1 scale 0.2 }
#declare Blue = pigment { rgb <0.2, 0.3, 0.9> }
#macro Raise(H) #declare H = H + 5; #end
#macro Column(Name, At)
  #local Width = 0.3;
  #declare local[concat("Wid", "er")] = local[concat("Wid", "th")] + 0.1;
  Raise(global[Name])
  box { <At - Wider, 0, 0>, <At + Wider, global[Name], 0.5> pigment { global[Kinds[mod(At + 4, 3)]] } }
#end
#for (I, 0, 4) Column(concat("Height", str(I, 0, 0)), I - 2) #end
#declare Steps = array[2] { <0, -0.5, 0>, <2, -0.5, 0> }
#declare Which = "Steps";
#declare Other = concat(Which, "2");
#ifdef (global[Other]) sphere { 0, 9 } #else sphere { global[Which][1], 0.4 pigment { Red } } #end
plane { y, -1 pigment { rgb 0.6 } }
