// doubt in line 0: a scene without a light
camera { location -5*z look_at 0 }
sphere { 0, 1 pigment { rgb 1 } }
