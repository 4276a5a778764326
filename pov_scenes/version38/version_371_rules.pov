// Scenes of version 3.71 are drawn by the rules of 3.8: turbulence of `wood`, steps of media, the background's filter.
#version 3.71;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
background { rgbf <0.2, 0.4, 0.6, 0.3> }
sphere { -1.5*x, 1.2 pigment { wood turbulence 0.3 scale 0.4 } }
box { -1, 1 hollow pigment { rgbt 1 } interior { media { emission 0.5 samples 8 density { spherical color_map { [0 rgb 0] [1 rgb <1, 0.5, 0.2>] } } } } translate 1.5*x }
