// mistake in line 3: a transform of a declared object without `object { }`
#declare Ball = sphere { 0, 1 }
Ball translate 2*x
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
