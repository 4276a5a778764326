// Level and upright rays: an orthographic view along the ground and one from above.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z look_at 0 right 4*x up 3*y }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
lathe { cubic_spline 6, <0.2, -0.9>, <0.1, -0.7>, <0.7, -0.4>, <0.3, 0.2>, <0.5, 0.7>, <0.6, 1> translate -x pigment { rgb <0.5, 0.8, 0.3> } }
lathe { bezier_spline 8, <0.3, -0.3>, <0.6, -0.5>, <0.8, -0.2>, <0.8, 0>, <0.8, 0>, <0.8, 0.3>, <0.4, 0.2>, <0.3, -0.3> rotate 90*x translate x pigment { rgb <0.7, 0.3, 0.6> } }
