// Ground behind a parallel spotlight, which lights only what is before it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,2,-5> look_at <0,-1,0> }
light_source { <1,3,2>, rgb <0.8,0.7,0.4> spotlight parallel point_at 0 }
light_source { <-3,2,1>, rgb <0.2,0.3,0.6> parallel point_at 0 }
plane { y, -1.2 pigment { checker rgb 1 rgb 0.7 } }
sphere { <1,2.2,2.5>, 0.8 pigment { rgb 1 } }
