// Both methods at three thresholds and three depths: solids, a mirror, a chequered floor.
// compare: channel<=4 pixels<=0.1% because "a sample that falls exactly on an edge goes to either side"
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
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
background { rgb <0.5, 0.7, 0.9> }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
torus { 0.8, 0.25 rotate -50*x translate <-0.9, 0, 0> pigment { rgb <0.9, 0.5, 0.2> } finish { phong 0.7 } }
difference {
  box { -0.7, 0.7 }
  sphere { 0, 0.9 }
  rotate <20, 40, 0> translate 1.2*x
  pigment { rgb <0.3, 0.7, 0.4> } finish { reflection 0.3 }
}
