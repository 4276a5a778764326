// mistake in line 3: an object for a texture
#declare Ball = sphere { 0, 1 }
box { -1, 1 texture { Ball } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
