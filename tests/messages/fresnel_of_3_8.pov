// mistake in line 4: `fresnel` in a finish, as from version 3.8 on
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 5*z, 1 pigment { rgb 1 } finish { fresnel 1 emission 1 } interior { ior 1.5 } }
