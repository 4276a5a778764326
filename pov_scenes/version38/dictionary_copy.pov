// A declared copy of a dictionary is a dictionary of its own.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare D = dictionary { .Size: 0.5 }
#declare E = D;
#declare E.Size = 1;
sphere { -1.5*x, D.Size }
sphere { 1.5*x, E.Size pigment { rgb <1, 0.5, 0.2> } }
