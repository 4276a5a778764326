// mistake in line 7: a part behind a modifier of the union
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
#declare Ball = sphere { 0, 1 }
union {
  box { -1, 1 } Ball
  rotate 20*y Ball
}
