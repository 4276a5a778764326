// mistake in line 2: a comma between the parts of a union
union { sphere { 0, 1 }, box { -1, 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
