// mistakes in lines 2, 3, 4: vectors in parentheses
sphere { (0, 0, 0), 1 pigment { rgb 1 } }
sphere { 0, 1 pigment { rgb (1, 0, 0) } }
#declare P = (1, 2, 3);
