// mistakes in lines 2, 3, 4: words of other programs
camera { position -5*z look_at 0 }
cube { -1, 1 }
sphere { 0, 1 pigment { rgb 1 opacity 0.5 } }
light_source { <4, 6, -8>, rgb 1 }
