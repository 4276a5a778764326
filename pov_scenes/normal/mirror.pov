// A mirror image goes by the tilted normal; where it would go into the surface, by the flat one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
#declare Bumpy = normal { bumps 1.5 scale 0.15 }
sphere { 0, 1 pigment { rgb 0.3 } normal { Bumpy } finish { reflection 0.7 specular 0.6 } }
plane { y, -1.07 pigment { checker rgb 1 rgb <0.8, 0.2, 0.1> } }
