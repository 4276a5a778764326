// With `max_trace_level 2` a mirror seen in a mirror is black where it would reflect.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 2 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1, 0, 0>, 0.9 pigment { rgb <0.05, 0, 0> } finish { reflection 0.9 } }
sphere { <1, 0, 0>, 0.9 pigment { rgb <0, 0, 0.05> } finish { reflection 0.9 } }
