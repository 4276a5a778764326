light_source { <1, 2, 3> }
sphere { 0, 1 }
camera { location -5*z }
