// mistake in line 3: a colour in texture
#declare Orange = rgb <1, 0.5, 0>;
sphere { 0, 1 texture { Orange } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
