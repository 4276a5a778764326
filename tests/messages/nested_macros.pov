// mistake in line 3: a wrong word inside a macro that another one calls
#macro Inner(R)
  sphere { 0, R radius 2 }
#end
#macro Outer(R)
  union { Inner(R) Inner(2*R) }
#end
Outer(1)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
