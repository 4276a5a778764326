// mistake in line 3: a declared camera without `camera { }`
#declare Cam = camera { location -5*z look_at 0 }
Cam
sphere { 0, 1 }
light_source { <4, 6, -8>, rgb 1 }
