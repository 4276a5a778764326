// doubt in line 3: a division by zero
#declare D = 0;
#declare A = 1/D;
sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
