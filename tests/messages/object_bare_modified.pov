// mistake in line 3: several modifiers behind the name of an object
#declare Ball = sphere { 0, 1 }
Ball translate x rotate 45*y pigment { rgb 1 }
