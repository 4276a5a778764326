// Media with random samples: where rounding leaves intervals short of the way, the rest takes random numbers too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> look_at 0 angle 50 }
#declare Glow = density { gradient z scale 4 translate -2*z color_map { [0 rgb 0] [1 rgb <2, 1.4, 0.8>] } }
box { -1.2, <-0.1, 1.2, 1.2> hollow pigment { rgbt 1 } interior { media { method 1 intervals 3 samples 1, 1 emission 0.25 density { Glow } } } }
box { <0.1, -1.2, -1.2>, 1.2 hollow pigment { rgbt 1 } interior { media { method 2 jitter 1 intervals 5 samples 2, 2 emission 0.25 density { Glow } } } }
