// Lathes of straight, quadratic, cubic and Bezier curves.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
lathe { 5, <0, -0.7>, <0.7, -0.7>, <0.3, 0>, <0.7, 0.5>, <0, 0.7> rotate 20*x translate <-1.8, 0.4, 0> pigment { rgb <0.8, 0.5, 0.2> } }
lathe { quadratic_spline 5, <0, -1>, <0.2, -0.7>, <0.7, -0.4>, <0.3, 0.4>, <0.5, 0.7> rotate -20*x translate <-0.5, 0.6, 0> pigment { rgb <0.2, 0.5, 0.8> } }
lathe { cubic_spline 6, <0.2, -0.9>, <0.1, -0.7>, <0.7, -0.4>, <0.3, 0.2>, <0.5, 0.7>, <0.6, 1> rotate 30*z translate <0.8, 0.5, 0> pigment { rgb <0.5, 0.8, 0.3> } finish { phong 0.5 } }
lathe { bezier_spline 8, <0.3, -0.3>, <0.6, -0.5>, <0.8, -0.2>, <0.8, 0>, <0.8, 0>, <0.8, 0.3>, <0.4, 0.2>, <0.3, -0.3> rotate -40*x translate <1.8, -0.7, -0.3> pigment { rgb <0.7, 0.3, 0.6> } }
lathe { linear_spline 2, <0.5, -0.2>, <0.2, 0.5> rotate <40, 0, 20> translate <-0.5, -0.8, -0.8> pigment { rgb <0.9, 0.8, 0.2> } }
