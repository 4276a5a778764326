// Fog that attenuates area lights: over the distance of one of their lights, or to twice their coordinates
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -9> look_at <0, 0.6, 0> angle 40 }
fog { distance 40 rgb <0.3, 0.35, 0.4> }
light_source { <-8, 12, -6>, rgb <1.6, 0.6, 0.3> area_light <3, 0, 1>, <0, 2, 0>, 3, 3 media_attenuation on }
light_source { <6, 8, -9>, rgb <0.3, 0.8, 1.2> area_light <2, 0, 1>, <0, 3, 0>, 4, 4 adaptive 1 media_attenuation on }
light_source { <-3, 7, 2>, rgb 0.3 parallel point_at x area_light <3, 0, 1>, <0, 2, 0>, 3, 2 media_attenuation on }
light_source { <2, 9, 4>, rgb <0.2, 0.5, 0.2> area_light 2*x, 2*z, 6, 5 adaptive 0 circular orient media_attenuation on }
plane { y, 0 pigment { checker rgb 1, rgb 0.6 } }
sphere { <-1.4, 0.8, 0>, 0.8 pigment { rgb 0.9 } finish { phong 0.6 } }
box { <0.4, 0, -0.6>, <1.8, 1.4, 0.6> pigment { rgb 0.8 } rotate 20*y }
