// doubt in line 3: an item that holds a function gets another
#declare F = array[1] { function { x } }
#declare F[0] = function { y }
#undef F[0] #declare F[0] = function { 2*x }
sphere { 0, F[0] (1, 0, 0) pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
