// `#debug` and `#warning` write messages and change nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#debug concat("radius ", str(0.8, 0, 3), "\n")
#warning "only a warning"
sphere { 0, 0.8 pigment { rgb <0.6, 0.8, 0.5> } }
