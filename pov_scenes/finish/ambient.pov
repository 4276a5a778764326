// Ambient light in grey and in colour, without any lamp.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
sphere { <-1.4, 0, 0>, 0.6 pigment { rgb <1, 0.8, 0.5> } finish { ambient 0.3 } }
sphere { <0, 0, 0>, 0.6 pigment { rgb <1, 0.8, 0.5> } finish { ambient 1 } }
sphere { <1.4, 0, 0>, 0.6 pigment { rgb <1, 0.8, 0.5> } finish { ambient rgb <0.2, 0.9, 0.5> } }
