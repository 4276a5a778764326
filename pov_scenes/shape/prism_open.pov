// Open prisms have no caps, neither straight nor conic ones.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
prism { -0.5, 0.5, 5, <-0.7, -0.7>, <0.7, -0.7>, <0.7, 0.7>, <-0.7, 0.7>, <-0.7, -0.7> open rotate <-60, 20, 0> translate <-1.5, 0.2, 0> pigment { rgb <0.8, 0.5, 0.2> } }
prism { conic_sweep cubic_spline 0.3, 1, 7, <1, -1>, <0, 0.7>, <-0.9, 0>, <0, -0.7>, <1, 0.1>, <0, 0.7>, <-1, -1> open rotate <-60, 20, 0> translate <1.2, -0.3, 0> pigment { rgb <0.5, 0.8, 0.3> } }
