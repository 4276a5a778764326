// mistakes in lines 2, 3: two declarations as in C; what uses them is right
float A = 1;
float B = 2;
sphere { 0, A pigment { rgb 1 } }
box { 0, B pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
