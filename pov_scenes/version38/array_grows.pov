// An array without a size grows to hold the item that is declared.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A = array;
#for (I, 0, 6) #declare A[I] = sphere { <I - 3, 0, 0>, 0.4 } #end
#for (I, 0, dimension_size(A, 1) - 1) object { A[I] pigment { rgb <I / 6, 0.5, 1> } } #end
