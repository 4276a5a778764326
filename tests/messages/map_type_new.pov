// mistake in line 4: a map_type of version 3.8
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 pigment { image_map { png "pov_scenes/texture/images/rgb.png" map_type 7 } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
