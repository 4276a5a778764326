// mistake in line 2: a path with `\`
plane { y, 0 pigment { image_map { png "C:\Users\me\new.png" } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
