// mistake in line 5: only colours are blended by a mode
#version 3.8;
global_settings { assumed_gamma 1 }
sphere { 0, 1
  texture { gradient x texture_map { blend_mode 2 [0 pigment { rgb 1 }] [1 pigment { rgb 0 }] } }
}
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
