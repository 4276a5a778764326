// A camera that counts angles and has none looks along one line only; to one that does not, `angle 0` says nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { ultra_wide_angle location <0.2, 0.1, -4> angle 0 look_at <0.2, 0.1, 0> }
sphere { 0, 1 pigment { rgb <0.2, 0.6, 0.9> } finish { ambient 1 diffuse 0 } }
plane { y, -1 pigment { checker rgb 1, rgb 0.2 } finish { ambient 1 diffuse 0 } }
