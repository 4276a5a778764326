// A texture_map in another.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
#declare A = texture { pigment { rgb <0.9, 0.2, 0.1> } finish { phong 0.5 } }
#declare B = texture { pigment { bozo scale 0.2 } normal { bumps 0.5 scale 0.1 } finish { reflection 0.3 } }
#declare C = texture { pigment { rgbf <0.8, 1, 0.8, 0.7> } finish { specular 0.5 } }
sphere { 0, 1 texture { bozo texture_map { [0.3 A] [0.5 wood texture_map { [0 B] [1 C] } scale 0.1] } scale 0.5 } }
plane { y, -1.07 texture { bozo texture_map { [0.3 A] [0.5 wood texture_map { [0 B] [1 C] } scale 0.1] } scale 0.5 } }
