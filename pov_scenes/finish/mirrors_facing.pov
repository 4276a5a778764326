// Mirrors that face each other end after `max_trace_level` rays, five by default.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.4, 0.6, -2> look_at <0, 0, 3> angle 60 }
light_source { <0, 3, 0>, rgb 1 }
plane { z, 4 pigment { rgb <0.1, 0.1, 0.15> } finish { reflection 0.9 } }
plane { -z, 3 pigment { rgb <0.15, 0.1, 0.1> } finish { reflection 0.9 } }
plane { y, -1 pigment { checker rgb 0.9, rgb <0.2, 0.5, 0.3> } }
sphere { <-0.3, -0.2, 1.5>, 0.7 pigment { rgb <0.9, 0.6, 0.2> } }
