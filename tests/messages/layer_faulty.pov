// mistake in line 3: a misspelt word in the lower of two layers
#declare T =
  texture { pigmnt { rgb 1 } }
  texture { pigment { rgb <1, 0, 0> transmit 0.5 } };
sphere { 0, 1 texture { T } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
