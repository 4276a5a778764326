// Without a background empty space is black.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
sphere { 0, 0.9 pigment { rgb <0.9, 0.6, 0.3> } finish { reflection 0.5 } }
