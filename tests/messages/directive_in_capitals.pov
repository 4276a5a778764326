// mistake in line 2: a directive with a capital; what it would declare is right
#Include "colors.inc"
sphere { 0, 1 pigment { Red } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
