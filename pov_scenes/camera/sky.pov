// `sky` leans the camera; it is used by look_at wherever it stands.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1, -5> look_at 0 sky <0.4, 1, 0> }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb <0.6, 0.6, 0.9> } }
