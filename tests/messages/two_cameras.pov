// doubt in line 4: two cameras
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
camera { location -9*z look_at 0 }
sphere { 0, 1 }
