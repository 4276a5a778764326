// mistake in line 2: the brace after a word is missing
fog fog_type 2 distance 10 color rgb 1 }
sphere { 0, 1 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
