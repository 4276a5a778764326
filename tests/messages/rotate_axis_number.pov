// mistakes in lines 2, 3, 4, 5: an axis and a number side by side
sphere { 0, 1 rotate y 45 }
sphere { 0, 1 rotate -45 y }
sphere { 0, 1 translate z 2 }
sphere { 0, 1 scale y 2 }
