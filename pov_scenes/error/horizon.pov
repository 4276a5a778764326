// A chequered plain that reaches the horizon.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.8, -3> look_at <0, 0.6, 0> angle 50 }
light_source { <-4, 6, -8>, rgb 0.8 }
background { rgb <0.4, 0.55, 0.8> }
plane { y, 0 pigment { checker rgb 0.85, rgb <0.15, 0.1, 0.1> } finish { ambient 0.1 diffuse 0.8 } }
