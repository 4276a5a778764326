// Soft things: fog, a spotlight with a soft edge, a sky.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -6> look_at 0 angle 45 }
light_source { <-3, 5, -4>, rgb 0.9 spotlight point_at 0 radius 12 falloff 20 }
light_source { <5, 6, -8>, rgb 0.2 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.7, 0.7, 0.6>] [1 rgb <0.2, 0.3, 0.6>] } } }
fog { distance 20 rgb <0.6, 0.6, 0.55> }
plane { y, -1 pigment { rgb <0.6, 0.5, 0.4> } }
sphere { 0, 1 pigment { rgb <0.7, 0.3, 0.2> } finish { phong 0.3 } }
box { <1, -1, 2>, <2, 1, 12> pigment { rgb <0.3, 0.5, 0.3> } }
