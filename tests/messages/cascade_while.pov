// mistakes in lines 2, 3: no `;`, and `<<` for `<`
#declare I = 0
#while (I << 3)
  sphere { I*x, 1 }
  #declare I = I + 1;
#end
box { -1, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
