// After a `#default` a further `#version` leaves all defaults alone, those of the camera included.
// size: 200x100
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { phong 0.5 } }
#version 3.8;
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { -1.5*x, 1 pigment { rgb <1, 0.5, 0.2> } }
sphere { 1.5*x, 1 }
