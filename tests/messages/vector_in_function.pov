// mistake in line 2: a function of vectors
isosurface { function { vlength(<x, y, z>) - 1 } contained_by { box { -2, 2 } } pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
