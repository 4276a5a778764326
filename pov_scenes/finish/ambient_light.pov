// `ambient_light` multiplies the ambient of every object.
#version 3.7;
global_settings { assumed_gamma 1 ambient_light rgb <1, 2, 4> }
camera { location <0, 2, -6> look_at 0 angle 38 }
sphere { <-1, 0, 0>, 0.8 pigment { rgb 1 } }
sphere { <1, 0, 0>, 0.8 pigment { rgb <0.5, 0.4, 0.1> } finish { ambient 0.5 emission 0.1 } }
