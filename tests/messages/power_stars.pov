// mistakes in lines 2, 3: a power of other languages
#declare A = 2 ** 3;
#declare B = 2 ^ 3;
