// A list of pigments that is too short ends in the default pigment.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#default { pigment { rgb <0.2, 0.8, 0.4> } }
plane { -z, -1 pigment { brick pigment { rgb 1 } scale 0.1 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { checker pigment { rgb 1 } scale 0.5 } }
