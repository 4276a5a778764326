// Ground fog that attenuates area lights behind panes, from the surface on but over the rest of the distance
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -9> look_at <0, 0.6, 0> angle 40 }
fog { fog_type 2 distance 4 fog_offset 0.2 fog_alt 1.2 rgb <0.3, 0.35, 0.4> }
light_source { <-8, 12, -6>, rgb <2.4, 1.6, 0.9> area_light <3, 0, 1>, <0, 2, 0>, 4, 4 adaptive 1 media_attenuation on }
light_source { <6, 8, -9>, rgb <0.6, 0.9, 1.6> area_light <2, 0, 1>, <0, 3, 0>, 5, 5 media_attenuation on }
plane { y, 0 pigment { checker rgb 1, rgb 0.6 } }
box { <-3, 1.2, -1>, <-0.4, 1.3, 2> pigment { rgbf <0.9, 0.7, 0.6, 0.9> } }
sphere { <1.2, 2.2, -0.5>, 0.8 pigment { rgbt <0.8, 0.9, 1, 0.7> } }
sphere { <0.2, 0.6, 0.8>, 0.6 pigment { rgb 0.9 } finish { phong 0.6 } }
