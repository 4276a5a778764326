// Media of method 3, whose steps fill an interval: emission and absorption with densities.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at <0, 0.7, 0> angle 45 }
light_source { <3, 6, -4> rgb 1.5 }
plane { y, 0 pigment { checker rgb 0.8 rgb 0.4 } }
#declare Glow = media { emission <0.9, 0.5, 0.2> density { spherical } }
#declare Dust = media { absorption <0.3, 0.6, 0.9> intervals 2 samples 1 density { spherical poly_wave 0.5 } }
sphere { 0, 0.9 pigment { rgbt 1 } hollow interior { media { Glow } } translate <-1, 1, 0> }
sphere { 0, 0.9 pigment { rgbt 1 } hollow interior { media { Dust } } translate <1, 1, 0> }
