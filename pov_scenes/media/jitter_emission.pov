// A jittered light is not sampled in media that only emit or absorb.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0.5, -4> look_at 0 angle 45 }
light_source { <4, 6, -5>, 1 area_light x, y, 3, 3 jitter media_interaction on media_attenuation on }
plane { y, -1 pigment { rgb 0.8 } finish { ambient 0 } }
sphere { -0.8*x, 0.75 pigment { rgbt 1 } hollow finish { ambient 0 diffuse 0 }
  interior { media { method 3 samples 7 intervals 1 emission <1, 0.5, 0.2>
    density { bozo color_map { [0 rgb 0][0.5 rgb 0][0.7 rgb 0.6][1 rgb 1] } scale 0.3 } } } }
sphere { 0.8*x, 0.75 pigment { rgbt 1 } hollow finish { ambient 0 diffuse 0 }
  interior { media { method 1 samples 4 intervals 2 absorption 1 emission 0.2
    density { gradient x color_map { [0 rgb 0][0.5 rgb 0][0.5 rgb 1][1 rgb 1] } scale 0.6 } } } }
