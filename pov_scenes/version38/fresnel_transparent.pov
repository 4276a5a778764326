// The own light of glass with `fresnel` in its finish, seen from both sides.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { y, -1.2 pigment { checker rgb 1, rgb <0.3, 0.5, 1> } }
sphere { 0, 1.2 pigment { rgbt <1, 0.6, 0.3, 0.6> } finish { diffuse 0.7 specular 0.6 reflection 1 fresnel 1 conserve_energy } interior { ior 1.5 } }
