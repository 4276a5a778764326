// mistake in line 2: channels from 0 to 255 behind a component
sphere { 0, 1 pigment { color red 255, 0, 0 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
