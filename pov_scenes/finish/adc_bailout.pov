// A high `adc_bailout` ends reflections that would add less than it.
#version 3.7;
global_settings { assumed_gamma 1 adc_bailout 0.3 max_trace_level 10 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.5, 0, 0>, 0.7 pigment { rgb 0.1 } finish { reflection 0.25 } }
sphere { <0, 0, 0>, 0.7 pigment { rgb 0.1 } finish { reflection 0.35 } }
sphere { <1.5, 0, 0>, 0.7 pigment { rgb 0.1 } finish { reflection 0.7 } }
