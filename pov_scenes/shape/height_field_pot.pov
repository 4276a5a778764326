// A smooth height field of a pot file: a GIF whose left half holds the high bytes and whose right half the low ones.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.5, 1.4, -1.2> look_at <0.5, 0.2, 0.5> angle 45 }
light_source { <-3, 5, -4>, 1 }
height_field { pot "heights/potential.pot" smooth pigment { rgb <0.9, 0.6, 0.3> } scale <1, 0.4, 1> }
