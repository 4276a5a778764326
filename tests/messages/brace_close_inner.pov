// mistake in line 8: no `}` behind a pigment
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
sphere {
  0, 1
  pigment { rgb 1
}
box { -1, 1 }
