// mistake in line 5: an `#end` too many
#if (1)
sphere { 0, 1 }
#end
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
