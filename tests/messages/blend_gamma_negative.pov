// mistake in line 5: a gamma that is no power
#version 3.8;
global_settings { assumed_gamma 1 }
sphere { 0, 1
  pigment { gradient x color_map { blend_gamma -1 [0 rgb 0] [1 rgb 1] } }
}
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
