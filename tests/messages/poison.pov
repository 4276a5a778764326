// mistake in line 2: a misspelt word in a declared object that is used later
#declare S = sphere { 0, 1 pigmnt { rgb 1 } }
object { S }
object { S translate x }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
