// `caustics` gather light behind a clear thing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sphere { <-1.3, 1.1, 0>, 1 pigment { rgbf <0.9, 0.9, 1, 0.9> } interior { ior 1.5 caustics 0.5 } }
sphere { <1.3, 1.1, 0>, 1 pigment { rgbt <0.9, 0.5, 0.5, 0.6> } interior { caustics 1.5 } }
cylinder { <0, 0.1, 2>, <0, 2, 2>, 0.6 pigment { rgbf <0.6, 0.9, 0.6, 0.8> } finish { caustics 0.7 } }
