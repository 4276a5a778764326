// `fresnel` in a finish follows the bumped normal.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1.6 pigment { rgb <1, 0.6, 0.3> } normal { bumps 0.6 scale 0.3 } finish { diffuse 0.8 specular 0.8 emission 0.2 fresnel 1 } interior { ior 1.6 } }
