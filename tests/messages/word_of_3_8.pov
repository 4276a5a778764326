// mistake in line 4: a word of version 3.8 in a scene of 3.7
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Box_list = dictionary;
sphere { 5*z, 1 pigment { rgb 1 } finish { emission 1 } }
