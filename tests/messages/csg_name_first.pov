// mistake in line 5: a name that comes first is the whole of the union
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
#declare Ball = sphere { 0, 1 }
union { Ball box { -1, 1 } }
