// mistake in line 2: an equation without `function`
isosurface { x*x + y*y - 1 contained_by { sphere { 0, 1 } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
