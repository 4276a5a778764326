// mistake in line 5: a macro call with a third argument
#macro Ball(P, R)
  sphere { P, R }
#end
Ball(1, 2, 3)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
