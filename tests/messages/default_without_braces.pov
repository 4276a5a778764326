// mistake in line 2: `#default` without braces
#default pigment { rgb 1 }
sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
