// Back in version 3.7 an object has the black pigment again; the camera is that of its place in the text.
// size: 200x100
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
#version 3.7;
light_source { <5, 8, -6>, 0.8 }
sphere { -1.5*x, 1 pigment { rgb <1, 0.5, 0.2> } }
sphere { 1.5*x, 1 finish { phong 0.7 } }
