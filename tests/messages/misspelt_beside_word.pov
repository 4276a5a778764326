// mistake in line 3: a name that resembles a declared one and a word
#declare box1 = box { 0, 1 }
object { box2 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
