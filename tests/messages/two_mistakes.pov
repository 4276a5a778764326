// mistake in line 2: two mistakes in a line, each with its remedy
Sphere { <0, 0, 0> 1 Pigment { rgb 1 } }
