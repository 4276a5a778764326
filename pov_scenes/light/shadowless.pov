// A shadowless lamp casts no shadow and makes no highlight.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 0.6 shadowless }
light_source { <6, 6, -4>, rgb 0.5 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb <0.8, 0.4, 0.3> } finish { phong 1 } }
