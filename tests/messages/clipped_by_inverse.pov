// mistake in line 4: `inverse` behind the object that clips
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
box { -1, 1 clipped_by { sphere { 0, 1.2 } inverse } }
