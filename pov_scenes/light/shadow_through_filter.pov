// Shadows of clear solids are tinted by filter and dimmed by transmit, surface by surface.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.4, 0.4, 0>, 0.6 pigment { rgbf <0.9, 0.2, 0.2, 0.9> } }
sphere { <0, 0.4, 0>, 0.6 pigment { rgbt <0.2, 0.9, 0.2, 0.7> } }
sphere { <1.4, 0.4, 0>, 0.6 pigment { rgbft <0.3, 0.3, 0.9, 0.5, 0.4> } }
