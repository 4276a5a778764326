// Rays across the axis of a surface of revolution, level or almost.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sor { 6, <0.2, -1.2>, <0.3, -0.8>, <0.7, -0.2>, <0.2, 0.4>, <0.4, 0.8>, <0.5, 1.2> rotate 20*x pigment { rgb <0.8, 0.5, 0.2> } }
