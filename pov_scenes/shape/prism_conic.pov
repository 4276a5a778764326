// Conic sweeps: one frustum, one up to its tip, one double cone and one hanging below its tip.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
prism { conic_sweep 0.4, 1, 5, <-0.7, -0.7>, <0.7, -0.7>, <0.7, 0.7>, <-0.7, 0.7>, <-0.7, -0.7> rotate <20, 30, 0> translate <-1.7, -0.5, 0> pigment { rgb <0.8, 0.5, 0.2> } }
prism { conic_sweep 0, 1, 7, <0, 0>, <0.8, 0>, <0.8, 0.4>, <0.4, 0.4>, <0.4, 0.8>, <0, 0.8>, <0, 0> rotate <150, 30, 0> translate <0, 1.2, 0> pigment { rgb <0.2, 0.5, 0.8> } }
prism { conic_sweep cubic_spline -1, 1, 7, <1, -1>, <0, 0.7>, <-0.9, 0>, <0, -0.7>, <1, 0.1>, <0, 0.7>, <-1, -1> scale 0.7 rotate <20, 20, 0> translate <1.7, 0, 0> pigment { rgb <0.5, 0.8, 0.3> } }
prism { conic_sweep bezier_spline -1, -0.2, 8, <-0.7, 0>, <-0.7, 0.8>, <0.7, 0.8>, <0.7, 0>, <0.7, 0>, <0.7, -0.3>, <-0.7, -0.9>, <-0.7, 0> scale 0.8 translate <0.2, -0.4, -0.6> pigment { rgb <0.7, 0.3, 0.6> } }
