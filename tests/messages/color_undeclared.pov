// mistake in line 2: a colour of an include file that is not included, behind `color`
sphere { 0, 1 pigment { color Gold } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
