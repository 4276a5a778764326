// mistake in line 2: an array of 3.8 in a scene without its version
#declare A = array mixed [2] { 1, <1, 2, 3> };
sphere { 0, A[0] pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
