// mistakes in lines 2, 3: a vector where a number belongs
plane { y, <0, 0, 0> }
torus { <0, 0, 0>, 1, 0.2 }
