// composite is union, a number alone in fog is its distance, unofficial is passed over.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
#version unofficial 3.6;
#version 3.7;
fog { color rgb <0.7, 0.8, 1> 12 }

plane { y, -1 pigment { checker rgb 1 rgb 0.2 } }
composite { sphere { -x, 1 } box { 0, 1 } pigment { rgb <1, 0.7, 0.3> } rotate 20*y }
#declare One = composite { sphere { 1.5*x, 0.5 pigment { rgb x } } }
object { One translate -0.4*y }
