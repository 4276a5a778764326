// Maps may have more than 256 entries.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1.6 pigment { gradient x scale 3.2 translate -1.6*x color_map { #for (I, 0, 400) [I / 400 rgb <mod(I, 7) / 7, mod(I, 50) / 50, I / 400>] #end } } }
