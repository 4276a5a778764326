// doubt in line 3: an sRGB colour before `assumed_gamma`
#version 3.7;
sphere { 0, 1 pigment { srgb <1, 0.5, 0> } }
global_settings { assumed_gamma 1 }
sphere { x, 1 pigment { srgb <1, 0.5, 0> } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
