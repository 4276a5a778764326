// mistake in line 2: a brace that ends the object within a vector; the rest is a consequence
box { 0, 1 pigment { rgb <0.8, 0.8, } 0.3> } }
sphere { 0, 1 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
