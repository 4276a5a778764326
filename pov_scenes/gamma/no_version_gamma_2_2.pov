// Without `#version`, an `assumed_gamma` of 2.2 is still obeyed.
global_settings { assumed_gamma 2.2 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb <0.5, 0.2, 0.02> } }
