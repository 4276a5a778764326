// Mirrors, glass and a checkered floor, at 640x480 under `assumed_gamma 1`, antialiased by both methods.
// size: 640x480
// switches: +A0.3
// switches: +A0.3 +AM2
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 }
camera { location <1.05, 2.4, -7> look_at <0.2, 0.7, 0> angle 42 }
light_source { <-6, 9, -8>, rgb 1 }
light_source { <8, 4, -3>, rgb <0.3, 0.25, 0.2> }
background { rgb <0.25, 0.4, 0.6> }
disc { 0, y, 40 pigment { checker rgb 0.9 rgb <0.15, 0.2, 0.25> } finish { reflection 0.15 } }
sphere { <-1.4, 1, 0.5>, 1 pigment { rgb <0.1, 0.1, 0.12> } finish { reflection { 0.2, 0.8 } phong 0.8 } }
sphere { <1, 0.9, -1>, 0.9 pigment { rgbf <0.95, 1, 0.97, 0.9> } finish { reflection 0.1 specular 0.6 } interior { ior 1.45 } }
torus { 0.8, 0.22 rotate <70, 20, 0> translate <1.9, 1, 1.4> pigment { rgb <0.8, 0.5, 0.1> } finish { phong 0.6 metallic } }
difference { box { <-0.5, 0, 1.6>, <0.6, 1.8, 2.6> } cylinder { <0.05, 1, 1>, <0.05, 1, 3>, 0.42 } rotate 15*y pigment { rgb <0.7, 0.2, 0.2> } }
