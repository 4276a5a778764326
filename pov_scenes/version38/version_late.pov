// A `#version 3.8` after other declarations is a warning; what precedes keeps the older defaults.
#declare Ball = sphere { -1.5*x, 1 texture { } }
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
object { Ball }
sphere { 1.5*x, 1 }
