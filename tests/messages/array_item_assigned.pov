// mistakes in lines 3, 4: items of an array without #declare
#declare A = array[2];
A[0] = 1;
A[1] = 2;
sphere { 0, A[0] pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
