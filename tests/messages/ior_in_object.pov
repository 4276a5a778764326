// mistake in line 2: `ior` in the object itself
sphere { 0, 1 pigment { rgbt 0.9 } ior 1.5 dispersion 1.1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
