// A checker stays regular across the origin into negative space.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0.05, 0.03, -5> look_at <0.05, 0.03, 0> right 8*x up 6*y }
plane { z, 0.5 pigment { checker rgb <1, 1, 0.8>, rgb <0.2, 0, 0.1> } finish { ambient 1 } }
