// mistake in line 2: `scale` in a finish
sphere { 0, 1 pigment { rgb 1 } finish { phong 1 scale 2 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
