// mistake in line 2: a number alone in an interior
sphere { 0, 1 pigment { rgbt 0.9 } interior { 1.5 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
