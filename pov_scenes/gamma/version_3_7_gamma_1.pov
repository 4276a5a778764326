// With `assumed_gamma 1` 0.5 becomes 188.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 0, -3> look_at 0 }
sphere { 0, 1 pigment { rgb <0.5, 0.2, 0.02> } finish { ambient 1 diffuse 0 } }
