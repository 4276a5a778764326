// mistake in line 5: an index that runs over the end of an array
#declare A = array[2] { 1, 2 }
#declare I = 0;
#while (I < 3)
  sphere { I*x, A[I] }
  #declare I = I + 1;
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
