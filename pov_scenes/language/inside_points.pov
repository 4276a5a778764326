// Shows that inside tells which points of a grid lie in a combination.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 3, -5> look_at 0 }
light_source { <5, 8, -6>, 1 }
#declare Solid = difference { sphere { 0, 1.3 } cylinder { -2*y, 2*y, 0.5 } plane { <1, 0, 1>, -0.2 } rotate 20*x }
#for (I, -6, 6) #for (K, -6, 6) #for (L, -6, 6)
  #if (inside(Solid, 0.2 * <I, K, L> + 0.01))
    sphere { 0.2 * <I, K, L>, 0.09 pigment { rgb <I + 6, K + 6, L + 6> / 12 } }
  #end
#end #end #end
