// Fog and media that take nothing from parallel light behind its plane
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -9> look_at <0, 0.6, 0> angle 45 }
fog { fog_type 2 distance 9 fog_offset 0.5 fog_alt 1 rgb <0.3, 0.35, 0.4> }
light_source { <-6, 4, 5>, rgb <0.9, 0.6, 1.5> parallel point_at <1, 0.8, 0.9> media_attenuation on }
light_source { <5, 5, 5>, rgb <0.9, 1.2, 0.6> parallel area_light x, z, 3, 3 media_attenuation on }
plane { y, 0 pigment { checker rgb 1, rgb 0.6 } }
sphere { <0.9, 0.8, 0.3>, 0.8 pigment { rgb 0.9 } finish { phong 0.6 } }
