// A second `assumed_gamma` is passed over with a warning.
#version 3.7;
global_settings { assumed_gamma 2.2 }
global_settings { assumed_gamma 1 max_trace_level 3 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
sphere { 0, 0.9 pigment { rgb <0.5, 0.2, 0.02> } }
