// `srgb` colours are decoded into the working space, whatever that is.
#version 3.7;
global_settings { assumed_gamma 2.2 }
camera { location <0, 2, -6> look_at 0 angle 38 }
sphere { <-1.4, 0, 0>, 0.6 pigment { srgb <0.5, 0.2, 0.02> } finish { ambient 1 } }
sphere { <0, 0, 0>, 0.6 pigment { srgbf <0.5, 0.2, 0.02, 0.3> } finish { ambient 1 } }
sphere { <1.4, 0, 0>, 0.6 pigment { color srgbt <0.5, 0.7, 0.9, 0.3> } finish { ambient 1 } }
