// Camera: a camera bends its rays as bumps bend normals.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 normal { bumps 0.3 scale 0.2 } }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
sphere { 0, 1 pigment { gradient x color_map { [0 rgb <0.9, 0.3, 0.2>] [1 rgb <0.2, 0.4, 0.9>] } scale 0.5 } finish { phong 0.5 } }
plane { y, -1.07 pigment { rgb 0.6 } }
