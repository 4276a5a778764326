// mistakes in lines 2, 3: words of a finish outside of it
sphere { 0, 1 pigment { rgb 1 } phong 1 }
sphere { 0, 1 pigment { rgb 1 ambient 1 } }
