// mistakes in lines 2, 3: patterns outside of a pigment or normal
plane { y, 0 checker rgb 0 rgb 1 }
sphere { 0, 1 bumps 0.5 }
