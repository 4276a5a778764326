// Shadows of a lattice, sharp and across each other.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -6> look_at 0 angle 42 }
light_source { <-4, 7, -2>, rgb 0.5 }
light_source { <5, 4, -4>, rgb <0.3, 0.28, 0.2> }
plane { y, -0.5 pigment { rgb <0.8, 0.75, 0.7> } finish { ambient 0.1 diffuse 0.8 } }
#for (I, -4, 4)
  box { <I*0.45 - 0.05, 0.5, -2>, <I*0.45 + 0.05, 0.56, 2> pigment { rgb <0.5, 0.3, 0.2> } }
  box { <-2, 0.7, I*0.45 - 0.03>, <2, 0.75, I*0.45 + 0.03> pigment { rgb <0.2, 0.4, 0.3> } }
#end
