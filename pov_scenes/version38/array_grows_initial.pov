// The size of an array without one is the number of values in its braces, and it grows beyond.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A = array { 0.3, 0.5, 0.7 }
#declare N = dimension_size(A, 1);
#declare A[N] = 0.9;
#for (I, 0, N) sphere { <I * 1.5 - 2.5, 0, 0>, A[I] pigment { rgb <I / 3, 0.5, 1> } } #end
