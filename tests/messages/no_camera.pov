// doubt in line 0: a scene without a camera
light_source { <4, 6, -8>, rgb 1 }
sphere { 0, 1 pigment { rgb 1 } }
