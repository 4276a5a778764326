// mistake in line 2: commas in a spotlight
light_source { <4, 6, -8>, rgb 1 spotlight radius 10, falloff 20 }
sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
