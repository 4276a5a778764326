// mistake in line 4: a word of HG-POV
#version 3.8;
global_settings { assumed_gamma 1 }
galley { 1 }
sphere { 5*z, 1 pigment { rgb 1 } finish { emission 1 } }
