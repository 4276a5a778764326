// mistake in line 3: a call of trace with too few arguments
#declare B = box { -1, 1 }
#declare P = trace(B, <0, 5, 0>);
sphere { P, 0.1 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
