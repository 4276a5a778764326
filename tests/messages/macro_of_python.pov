// mistake in line 2: the macro of Python
def ball(r)
  sphere { 0, r pigment { rgb 1 } }
#end
ball(1)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
