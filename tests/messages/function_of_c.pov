// mistake in line 2: a function as in C
float f(float x) { return x*x; }
sphere { 0, f(1) pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
