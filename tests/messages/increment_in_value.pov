// mistake in line 3: an increment as in C
#declare A = 1;
#declare B = A++;
sphere { 0, B pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
