// Fog that attenuates projected lights, also shadowless ones and those with an area
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -9> look_at <0, 0.6, 0> angle 40 }
fog { distance 30 rgb <0.3, 0.35, 0.4> }
#declare Gate = sphere { <0, 3, 0>, 1.6 }
light_source { <-8, 12, -6>, rgb <1.6, 0.6, 0.3> shadowless projected_through { Gate } media_attenuation on }
light_source { <6, 8, -9>, rgb <0.3, 0.8, 1.2> projected_through { Gate } media_attenuation on }
light_source { <2, 9, 3>, rgb 0.8 area_light <2, 0, 1>, <0, 3, 0>, 4, 4 projected_through { Gate } media_attenuation on }
light_source { <0, 9, -9>, rgb 0.6 shadowless area_light x, z, 3, 3 projected_through { Gate } media_attenuation on }
plane { y, 0 pigment { checker rgb 1, rgb 0.6 } }
sphere { <0.2, 0.6, 0.8>, 0.6 pigment { rgb 0.9 } finish { phong 0.6 } }
