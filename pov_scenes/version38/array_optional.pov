// The values of an `array optional` may be left out, or be names without a value.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare R = 0.8;
#declare A = array[4] optional { R, , Undeclared, 0.4 }
#for (I, 0, 3)
  #ifdef (A[I]) sphere { <I * 1.5 - 2.5, 0, 0>, A[I] } #else box { <I * 1.5 - 2.7, -0.2, -0.2>, <I * 1.5 - 2.3, 0.2, 0.2> } #end
#end
