// A background colour stands where no object is, also in mirrors.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
background { rgb <0.3, 0.5, 0.8> }
sphere { <-1, 0, 0>, 0.9 pigment { rgb <0.2, 0.1, 0> } finish { reflection 0.6 } }
sphere { <1, 0, 0>, 0.9 pigment { rgbf <1, 0.9, 0.5, 0.8> } }
