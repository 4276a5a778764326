// Emission adds to the surface whatever the lamps and `ambient_light` do.
#version 3.7;
global_settings { assumed_gamma 1 ambient_light 0 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1, 0, 0>, 0.8 pigment { rgb <0.9, 0.5, 0.2> } finish { emission 0.6 } }
sphere { <1, 0, 0>, 0.8 pigment { rgb <0.9, 0.5, 0.2> } finish { emission rgb <0, 0.3, 0.8> diffuse 0.2 } }
