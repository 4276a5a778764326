// A declared camera begins with what `#default` has set.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { camera { location <1, 2, -7> right 1.6*x } }
#declare Near = camera { look_at <0, 0.3, 0> angle 40 }
camera { Near translate 0.5*x }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1 pigment { rgb <0.9, 0.4, 0.2> } }
