// Antialiasing of method 3, whose samples lie at random.
// compare: channel<=80 pixels<=30% because "the samples of POV-Ray lie at random"
// switches: +A0.1 +AM3 +R3
// switches: +A0.05 +AM3 +R4 +AC0.95
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { y, -1 pigment { checker rgb 0.5 rgb <0.4, 0.45, 0.5> } finish { emission 0.3 } }
sphere { 0, 1 pigment { rgb <0.6, 0.5, 0.4> } finish { emission 0.3 } }
