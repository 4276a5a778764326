// mistake in line 3: a `trace` without `)`
#declare B = sphere { 0, 1 };
#declare P = trace(B, -5*z, z;
sphere { 0, 0.1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
