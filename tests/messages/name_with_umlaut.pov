// mistake in line 2: a letter of another alphabet in a name
#declare große_kugel = sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
