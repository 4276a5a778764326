// doubt in line 2: a scale by 0
sphere { 0, 1 scale <1, 0, 1> }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
