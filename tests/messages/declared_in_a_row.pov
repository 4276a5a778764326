// mistake in line 2: two names in one declaration
#declare A = 1, B = 2;
sphere { 0, A*B pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
