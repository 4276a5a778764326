// mistake in line 2: a component of colours as a name; its use is a consequence
#declare red = rgb <1, 0, 0>;
sphere { 0, 1 pigment { red } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
