// mistake in line 2: a comma in a block
sphere { 0, 1 pigment { rgb 1 } finish { ambient 0.1, diffuse 0.9 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
