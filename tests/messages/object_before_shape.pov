// mistake in line 2: `object` before a shape
#declare Ball = object sphere { 0, 1 }
object { Ball pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
