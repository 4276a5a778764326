// mistake in line 5: a macro call without parentheses
#macro Ball(P, R)
  sphere { P, R }
#end
union { Ball box { 1, 2 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
