// mistake in line 7: no `}` behind a part of a union
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
union {
  sphere { 0, 1
    pigment { rgb 1 }
  box { -1, 1 }
}
cylinder { 0, y, 1 }
