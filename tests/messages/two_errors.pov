// mistakes in lines 2, 3, 6: three objects, each with a mistake
sphere { 0, 1 pigmnet { rgb 1 } }
box { -1, 1 rotaet 45*y }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
cylinder { 0, y }
