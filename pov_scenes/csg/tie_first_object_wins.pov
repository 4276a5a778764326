// Of two coincident spheres and nothing else the one declared first is seen.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
sphere { 0, 1 pigment { rgb <0.9, 0.3, 0.3> } finish { ambient 1 } }
sphere { 0, 1 pigment { rgb <0.3, 0.3, 0.9> } finish { ambient 1 } }
