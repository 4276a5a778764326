// A wavy field, letters and fog, at 640x480 under `assumed_gamma srgb`, antialiased by both methods.
// size: 640x480
// switches: +A0.3
// switches: +A0.3 +AM2
#version 3.7;
global_settings { assumed_gamma srgb }
camera { location <0, 3, -9> look_at <0, 0.6, 0> angle 40 }
light_source { <20, 30, -25>, srgb <1, 0.95, 0.85> }
fog { distance 30 srgb <0.7, 0.75, 0.8> }
plane { y, 0 pigment { srgb <0.3, 0.35, 0.3> } normal { ripples 0.4 scale 0.7 } finish { reflection 0.3 } hollow }
text { ttf "crystal.ttf" "Aq7" 0.4, 0 scale 2.4 translate <-2.4, 0.6, 0> pigment { srgb <0.8, 0.25, 0.1> } finish { phong 0.5 } }
blob { threshold 0.6 sphere { <1.8, 0.8, -1>, 1.1, 1 } sphere { <2.7, 1.1, -0.6>, 0.9, 1 } cylinder { <1.8, 0.8, -1>, <2.2, 2, -0.4>, 0.5, 1 } pigment { srgb <0.2, 0.4, 0.7> } finish { specular 0.7 } }
mesh { #for (I, 0, 19) triangle { <-3, 0, -2>, <-3 + cos(I*pi/10), 1 + 0.5*mod(I, 2), -2 + sin(I*pi/10)>, <-3 + cos((I + 1)*pi/10), 1, -2 + sin((I + 1)*pi/10)> } #end pigment { srgb <0.5, 0.7, 0.3> } }
