// mistake in line 2: a finish without its block
sphere { 0, 1 texture { pigment { rgb 1 } phong 1 phong_size 40 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
