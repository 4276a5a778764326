// mistake in line 2: a digit first in a name
#declare 2balls = sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
