// mistake in line 7: a light group has no pigment
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
#declare Ball = sphere { 0, 1 }
light_group {
  Ball
  pigment { rgb 1 }
}
