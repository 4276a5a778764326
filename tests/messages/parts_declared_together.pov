// mistake in line 2: pigment and finish in one declaration
#declare T = pigment { rgb 1 } finish { phong 1 }
sphere { 0, 1 texture { T } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
