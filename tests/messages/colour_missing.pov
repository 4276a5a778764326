// doubts in lines 3, 4: colours without a value
camera { location -5*z look_at 0 }
background { }
light_source { <4, 6, -8>, rgb 1 } sphere { 0, 1 finish { reflection { fresnel } } }
