// mistakes in lines 2, 3: vectors without `<` and `>`
camera { location 0, 1, -5 look_at 0 }
sphere { 0, 1 translate 1, 2, 3 }
light_source { <4, 6, -8>, rgb 1 }
