// mistake in line 2: a colour of an include file for a texture
sphere { 0, 1 texture { Gold } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
