// A lathe behind a rotation, an uneven scaling, a mirror and a shear, and one of clear glass.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare L = lathe { bezier_spline 8, <0, -0.8>, <0.9, -0.8>, <0.2, -0.2>, <0.2, 0>, <0.2, 0>, <0.2, 0.4>, <0.8, 0.4>, <0.7, 0.8> }
object { L scale <1, 0.7, 0.5> rotate <20, 60, 10> translate <-1.7, 0.3, 0> pigment { rgb <0.8, 0.5, 0.2> } }
object { L matrix <1, 0.4, 0, -0.3, -0.8, 0.2, 0, 0, 1, 0.1, 0.3, 0> pigment { rgb <0.2, 0.5, 0.8> } finish { specular 0.5 } }
lathe { cubic_spline 6, <0.5, -1.5>, <0, -0.7>, <0.7, -0.4>, <0.4, 0.3>, <0, 0.7>, <-0.5, 1> rotate 30*z translate <1.6, 0, 0> pigment { rgbf <0.9, 1, 0.95, 0.9> } finish { reflection 0.1 } interior { ior 1.4 } }
