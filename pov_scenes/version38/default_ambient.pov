// From version 3.8 on the ambient light of a finish is 0 by default; a `finish` without it has none.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } }
plane { y, -1 pigment { rgb <0.2, 0.4, 0.6> } finish { diffuse 0.8 } }
sphere { <-1.5, 0, 1>, 0.8 pigment { rgb 1 } finish { ambient 0.2 } }
