camera { location -5*z angle 200 }
sphere { 0, 1 }
