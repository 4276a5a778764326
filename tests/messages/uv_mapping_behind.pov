// mistake in line 4: `uv_mapping` behind the texture
camera { location -5*z look_at 0 }
light_source { -9, rgb 1 }
sphere { 0, 1 pigment { checker scale 0.1 } uv_mapping }
