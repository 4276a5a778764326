// mistake in line 4: several names at once, as from version 3.8 on
#version 3.7;
global_settings { assumed_gamma 1 }
#declare (A, B) = (1, 2);
sphere { 5*z, 1 pigment { rgb 1 } finish { emission 1 } }
