// A CSG block that is a name takes clipped_by, bounded_by and split_union behind it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
#declare Ball = sphere { 0, 1 }
#declare Balls = union { sphere { -0.5*x, 0.6 } sphere { 0.5*x, 0.6 } pigment { rgb <0.4, 0.6, 1> } }

union { Ball clipped_by { plane { y, 0.2 } } pigment { rgb <1, 0.7, 0.3> } translate -1.3*x }
union { Balls split_union off bounded_by { sphere { 0, 1.2 } } clipped_by { plane { x, 0.5 } } translate 1.2*x }
merge { Ball bounded_by { box { -1, 1 } } scale 0.5 pigment { rgb x } translate 1.4*y }
