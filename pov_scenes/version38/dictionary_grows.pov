// Entries of an empty `dictionary` are declared one by one, under keys that may be computed.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare D = dictionary;
#for (I, 0, 4) #declare D[concat("k", str(I, 0, 0))] = 0.2 + I * 0.1; #end
#declare D.k2 = 0.8;
#for (I, 0, 4) sphere { <I * 1.3 - 2.6, 0, 0>, D[concat("k", str(I, 0, 0))] pigment { rgb <I / 4, 0.5, 1> } } #end
