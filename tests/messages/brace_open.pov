// mistake in line 4: no `{` behind `sphere`
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
sphere
  0, 1
  pigment { rgb 1 }
}
