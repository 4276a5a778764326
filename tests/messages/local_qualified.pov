// mistake in line 3: `#local` with a name that says where it is declared
#version 3.8;
#local global.Size = 1;
global_settings { assumed_gamma 1 }
sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
