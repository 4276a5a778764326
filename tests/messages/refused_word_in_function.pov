// doubt in line 2: a word for a number in a function
#declare F = function { x*on }
sphere { 0, F (1, 0, 0) pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
