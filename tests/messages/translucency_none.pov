// mistake in line 7: no translucency in green
#version 3.7;
global_settings { subsurface { samples 10, 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
sphere { 0, 1 pigment { rgb 1 } interior { ior 1.3 }
  finish { subsurface { translucency <1, 0, 1> } } }
