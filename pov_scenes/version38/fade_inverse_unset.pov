// `fade_power` without `fade_distance` fades by the inverse power from version 3.8 on.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
light_source { <-1, 1, -1.5>, rgb <1, 0.8, 0.4> * 2 fade_power 1.5 }
plane { y, -1 pigment { rgb 0.8 } }
sphere { 0, 1 }
