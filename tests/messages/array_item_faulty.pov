// mistake in line 3: an item that cannot be read; its uses are consequences
#declare F = array[1];
#declare F[0] = function(a. b) { a + b };
#declare G = F[0];
sphere { 0, 1 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
