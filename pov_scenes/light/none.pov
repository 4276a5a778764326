// Without a lamp only ambient light and emission remain.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1 pigment { rgb <0.9, 0.7, 0.4> } finish { ambient 0.5 } }
