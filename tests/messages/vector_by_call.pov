// mistake in line 2: a vector as in shaders
sphere { vec3(0, 1, 0), 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
