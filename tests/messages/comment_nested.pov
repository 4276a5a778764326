// mistake in line 3: a comment that opens another one
sphere { 0, 1 }
/* one /* and two */
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
