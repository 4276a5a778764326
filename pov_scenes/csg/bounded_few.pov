// With fewer than three objects and lights no box hides a plane, however small the bounds.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 angle 50 }
light_source { <5, 8, -9> 1 }
background { rgb 0.2 }
plane { <0, 1, 0.2>, -0.3 bounded_by { sphere { 0, 1 } } pigment { checker rgb <1, 0.4, 0.3>, rgb 0.9 } }
