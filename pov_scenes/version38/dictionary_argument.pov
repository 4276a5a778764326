// A macro changes the dictionary that it is passed, and a single entry as well.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Double(Thing) #declare Thing.Size = Thing.Size * 2; #end
#macro Halve(Number) #declare Number = Number / 2; #end
#declare D = dictionary { .Size: 0.4, .Other: 1.2 }
Double(D)
Halve(D.Other)
sphere { -1.5*x, D.Size }
sphere { 1.5*x, D.Other pigment { rgb <1, 0.5, 0.2> } }
