// `transform { }` gathers steps and acts as the same steps in a row.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
torus { 0.6, 0.2 transform { rotate 60*x scale <1, 1.4, 1> translate -1.1*x } pigment { rgb <0.9, 0.5, 0.7> } }
torus { 0.6, 0.2 rotate 60*x scale <1, 1.4, 1> translate 1.1*x pigment { rgb <0.5, 0.7, 0.9> } }
