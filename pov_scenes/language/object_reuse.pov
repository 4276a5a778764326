// An object's name may be used by `object` or by its own kind, with modifiers that add to its own.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Ball = sphere { 0, 0.6 pigment { rgb <0.9, 0.4, 0.3> } translate 0.1*y };
object { Ball translate -1.5*x }
sphere { Ball scale <1, 0.5, 1> pigment { rgb <0.3, 0.9, 0.4> } }
object { Ball scale 0.8 translate 1.5*x finish { phong 1 } }
