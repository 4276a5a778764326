// A scene a thousand times as large looks the same.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2000, -6000> look_at 0 angle 38 }
light_source { <-4000, 6000, -8000>, rgb 1 }
plane { y, -1010 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> scale 1000 } }
torus { 700, 250 rotate -30*x pigment { rgb <0.9, 0.5, 0.6> } }
