// mistakes in lines 2, 3: three numbers for a vector
sphere { 0, 1 translate 1 2 -3 }
sphere { 0, 1 pigment { color rgb 1 0.5 0 } }
