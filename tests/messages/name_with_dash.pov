// mistake in line 2: a dash in a name
#declare my-ball = sphere { 0, 1 }
object { my-ball }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
