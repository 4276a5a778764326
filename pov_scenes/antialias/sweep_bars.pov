// Both methods at three thresholds and three depths: bars hardly wider than a pixel.
// compare: channel<=10 pixels<=0.1% because "samples that fall exactly on the edge of a bar go to either side"
// switches: +A0.3 +AM1 +R2
// switches: +A0.3 +AM1 +R3 -J
// switches: +A0.3 +AM1 +R4
// switches: +A0.1 +AM1 +R2 -J
// switches: +A0.1 +AM1 +R3
// switches: +A0.1 +AM1 +R4 -J
// switches: +A0.02 +AM1 +R2
// switches: +A0.02 +AM1 +R3 -J
// switches: +A0.02 +AM1 +R4
// switches: +A0.3 +AM2 +R2
// switches: +A0.3 +AM2 +R3 -J
// switches: +A0.3 +AM2 +R4
// switches: +A0.1 +AM2 +R2 -J
// switches: +A0.1 +AM2 +R3
// switches: +A0.1 +AM2 +R4 -J
// switches: +A0.02 +AM2 +R2
// switches: +A0.02 +AM2 +R3 -J
// switches: +A0.02 +AM2 +R4
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.2, -6> look_at 0 angle 40 }
light_source { <-6, 5, -4>, rgb 0.8 }
background { rgb <0.5, 0.6, 0.75> }
plane { y, -1 pigment { rgb <0.4, 0.55, 0.3> } }
#for (I, -30, 30)
  box { <0.09*I - 0.02, -1, -0.01>, <0.09*I + 0.02, 0.7 + 0.1*mod(I + 30, 2), 0.01> pigment { rgb <0.8, 0.78, 0.7> } }
#end
