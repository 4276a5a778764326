// Normal: a list of normals.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
sphere { 0, 1 pigment { rgb 0.8 } normal { checker normal { bumps 0.6 scale 0.2 } normal { gradient x 0.5 scale 0.1 } scale 0.53 } finish { phong 0.5 } }
plane { y, -1.07 pigment { rgb 0.6 } normal { checker normal { bumps 0.6 scale 0.2 } normal { gradient x 0.5 scale 0.1 } scale 0.53 } }
