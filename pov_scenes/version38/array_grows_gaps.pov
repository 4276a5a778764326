// A growing array may have gaps, and `#ifdef` of an item makes it longer.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A = array;
#declare A[4] = 0.5;
#ifdef (A[8]) #declare N = 1; #else #declare N = dimension_size(A, 1); #end
#for (I, 0, N - 1)
  #ifdef (A[I]) sphere { <I - 4, 0, 0>, A[I] pigment { rgb <1, 0.5, 0.2> } } #else sphere { <I - 4, 0, 0>, 0.2 } #end
#end
