// mistake in line 2: a point less than announced
prism { 0, 1, 6 <0, 0>, <1, 0>, <1, 1>, <0, 1>, <0, 0> pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
