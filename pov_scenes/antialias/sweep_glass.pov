// Both methods at three thresholds and three depths: glass before stripes.
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
camera { location <0, 1, -6> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 0.8 }
background { rgb <0.4, 0.5, 0.6> }
plane { z, 3 pigment { gradient x color_map { [0.5 rgb 0.75] [0.5 rgb <0.2, 0.25, 0.4>] } scale 0.4 rotate 20*z } finish { ambient 0.6 diffuse 0.3 } }
#for (I, -1, 1)
  sphere { <1.4*I, 0.2*I, 0>, 0.65 pigment { rgbf <0.95, 0.97, 1, 0.93> }
    finish { reflection 0.08 specular 0.3 roughness 0.01 } interior { ior 1.45 } }
#end
