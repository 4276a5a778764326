// mistake in line 3: a texture without its word
#declare Shiny = texture { pigment { rgb 1 } finish { phong 1 } }
sphere { 0, 1 Shiny }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
