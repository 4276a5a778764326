// Prisms of straight, quadratic, cubic and Bezier outlines.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
prism { -0.2, 0.4, 7, <0, 0>, <1, 0>, <1, 0.5>, <0.5, 0.5>, <0.5, 1>, <0, 1>, <0, 0> rotate <-60, 20, 0> translate <-1.9, 0.4, 0> pigment { rgb <0.8, 0.5, 0.2> } }
prism { quadratic_spline 0, 0.5, 6, <1, -1>, <-0.6, -0.6>, <0.6, -0.6>, <0.6, 0.6>, <-0.6, 0.6>, <-0.6, -0.6> rotate <-70, 20, 0> translate <0, 0.6, 0> pigment { rgb <0.2, 0.5, 0.8> } }
prism { cubic_spline linear_sweep -0.3, 0.3, 7, <1, -1>, <0, 0.7>, <-0.9, 0>, <0, -0.7>, <1, 0.1>, <0, 0.7>, <-1, -1> rotate <-50, 20, 0> translate <1.7, 0.5, 0> pigment { rgb <0.5, 0.8, 0.3> } }
prism { bezier_spline -0.3, 0.3, 8, <-0.7, 0>, <-0.7, 0.8>, <0.7, 0.8>, <0.7, 0>, <0.7, 0>, <0.7, -0.3>, <-0.7, -0.9>, <-0.7, 0> rotate <-50, 20, 0> translate <-0.9, -0.7, -0.5> pigment { rgb <0.7, 0.3, 0.6> } }
prism { 0.4, -0.1, 10, <-0.6, -0.6>, <0.6, -0.6>, <0.6, 0.6>, <-0.6, 0.6>, <-0.6, -0.6>, <-0.3, -0.3>, <0.3, -0.3>, <0, 0.4>, <-0.3, 0.3>, <-0.3, -0.3> rotate <-50, -30, 0> translate <0.9, -0.7, -0.5> pigment { rgb <0.9, 0.8, 0.2> } }
