// mistake in line 3: a declared finish without `finish { }`
#declare F = finish { phong 1 }
sphere { 0, 1 pigment { rgb 1 } F }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
