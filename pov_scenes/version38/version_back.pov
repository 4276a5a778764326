// After `#version 3.7` the words of 3.8 stay, and the picture is drawn by the rules of 3.8: turbulence, media, the background.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#version 3.7;
background { rgbf <0.2, 0.4, 0.6, 0.3> }
sphere { -1.5*x, 1.2 pigment { wood turbulence 0.3 scale 0.4 } }
lemon { -y, 0.5, y, 0.3, 1.2 pigment { crackle repeat 2 scale 0.4 } }
box { -1, 1 hollow pigment { rgbt 1 } interior { media { emission 0.5 samples 8 density { spherical color_map { [0 rgb 0] [1 rgb <1, 0.5, 0.2>] } } } } translate 1.8*x }
