// mistakes in lines 2, 3: vectors in the brackets of other languages
sphere { [0, 0, 0], 1 }
box { {-1, 0, 0}, 1 }
