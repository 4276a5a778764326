// mistake in line 2: `end` without `#`
#macro Ball(R) sphere { 0, R } end
Ball(1)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
