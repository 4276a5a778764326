// mistake in line 4: an index that runs over the end of an array
#declare A = array[3] { 1, 2, 3 }
#for (I, 0, 3)
  sphere { I*x, A[I] }
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
