// doubts in lines 2, 3: a colour that begins with `t`
#declare Blue = color t*2;
sphere { 0, 1 pigment { color t + 0.5 } }
sphere { 2*x, 1 pigment { color (t) + Blue } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
