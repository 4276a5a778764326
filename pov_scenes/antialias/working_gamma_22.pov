// Colours are compared as linear light under `Antialias_Gamma` when the scene's own are not linear.
// switches: +A0.3
// switches: +A0.1 +AM2 +R2
// switches: +A0.2 +AG1.5 +R2 -J
#version 3.7;
global_settings { assumed_gamma 2.2 }
camera { location -3*z direction z right 4/3*x up y }
background { rgb 0.2 }
plane { z, 0
  pigment { granite scale 0.3 color_map { [0 rgb 0] [1 rgb <1, 0.9, 0.7>] } }
  finish { ambient 1 diffuse 0 }
}
sphere { -z, 0.3 pigment { gradient y scale 0.02 } finish { ambient 1 diffuse 0 } }
