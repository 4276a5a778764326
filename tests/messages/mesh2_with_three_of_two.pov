// mistake in line 2: more vertices than announced
mesh2 { vertex_vectors { 2, <0, 0, 0>, <1, 0, 0>, <0, 1, 0> } face_indices { 1, <0, 1, 2> } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
