// A torus seen exactly from its own plane.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
torus { 1.2, 0.4 pigment { rgb <0.4, 0.7, 0.9> } }
