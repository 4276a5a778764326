// Shadows of lights with jitter are found once for all layers and textures of a point, whatever is seen through which.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -6> look_at <0, 0.3, 0> angle 45 }
light_source { <-10, 20, -10> rgb 0.8 area_light 3*x, 3*y, 5, 5 adaptive 1 jitter }
#declare Veil = texture { pigment { granite color_map { [0.3 rgbt 1] [0.3 rgbt <0.9, 0.5, 0.3, 0.4>] } scale 2 } }
plane { y, 0 texture { pigment { rgb 0.6 } finish { crand 0.1 } } texture { Veil } }
sphere { <-0.8, 1, 0>, 0.7 pigment { rgb x } }
box { <0.4, 0.2, -0.5>, <1.4, 1, 0.5> texture { gradient y texture_map { [0 pigment { rgb z }] [1 pigment { rgb <1, 1, 0> }] } } }
