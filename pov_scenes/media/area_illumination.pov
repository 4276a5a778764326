// Media under fading lights and beams with `area_illumination`.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,1,-5> look_at 0 angle 60 }
light_source { <0.5,3,-2>, rgb <0.6,0,0> fade_distance 2 fade_power 2 area_light 2*x, 2*y, 3, 3 area_illumination }
light_source { <2,3,-1>, rgb <0,3,0> spotlight point_at <1.5,0,0> radius 5 falloff 20 area_light x, z, 2, 2 area_illumination }
light_source { <-2,3,-1>, rgb <0,0,3> cylinder point_at <-1.5,0,0> radius 0.2 falloff 0.8 area_light x, z, 2, 2 area_illumination }
box { <-3,-1.2,-3>, <3,-1,3> pigment { rgb 1 } }
sphere { 0, 9 hollow pigment { rgb 0.3 } }
media { scattering { 1, 0.03 } intervals 2 samples 5 }
