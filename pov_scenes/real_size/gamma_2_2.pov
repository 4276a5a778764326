// A fence of thin bars before a field of spheres, at 640x480 under `assumed_gamma 2.2`, antialiased by both methods.
// size: 640x480
// switches: +A0.3
// switches: +A0.3 +AM2
#version 3.7;
global_settings { assumed_gamma 2.2 }
camera { location <0, 1.6, -8> look_at <0, 1, 0> angle 48 }
light_source { <-30, 40, -50>, rgb 1 }
background { rgb <0.6, 0.75, 0.9> }
plane { y, 0 pigment { hexagon rgb <0.3, 0.5, 0.2> rgb <0.4, 0.55, 0.25> rgb <0.25, 0.4, 0.2> scale 0.5 } }
#for (I, -14, 14)
  cylinder { <0.25*I, 0, -2>, <0.25*I + 0.1, 1.7, -2>, 0.03 pigment { rgb <0.5, 0.3, 0.15> } }
#end
#for (I, 0, 59)
  sphere { <mod(I, 10) - 4.5, 0.3 + 0.4*int(I/10), 1 + 0.9*int(I/10)>, 0.32 pigment { rgb <mod(I, 3)/2, mod(I, 5)/4, mod(I, 7)/6> } finish { phong 0.7 } }
#end
