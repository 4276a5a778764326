// Without `subsurface` in the global settings that of a finish does nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sphere { <0, 1, 0>, 1 pigment { rgb <0.9, 0.8, 0.7> } finish { subsurface { translucency rgb <0.8, 0.3, 0.2> } } }
