// Media with random samples under a light: what only glows takes no light on its way, and no random numbers for it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> look_at 0 angle 50 }
light_source { <2, 3, -20>, 0.8 }
#declare Glow = density { gradient z scale 4 translate -2*z color_map { [0 rgb 0] [1 rgb <2, 1.4, 0.8>] } }
box { -1.2, <-0.1, 1.2, 1.2> hollow pigment { rgbt <0.3, 0.3, 0.6, 0.7> } interior { media { method 1 intervals 3 samples 1, 1 emission 0.2 density { Glow } } } }
box { <0.1, -1.2, -1.2>, 1.2 hollow pigment { rgbt <0.3, 0.3, 0.6, 0.7> } interior { media { method 2 jitter 1 intervals 5 samples 2, 2 emission 0.15 density { Glow } } } }
