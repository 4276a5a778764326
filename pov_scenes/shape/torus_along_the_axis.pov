// A torus seen exactly along its axis, orthographically.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -6> look_at 0 right 4*x up 3*y }
light_source { <-4, 6, -8>, rgb 1 }
torus { 0.9, 0.35 rotate 90*x pigment { rgb <0.9, 0.7, 0.4> } }
