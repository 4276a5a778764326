// `fresnel` in a finish sets that of the reflection; what comes later counts.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sky_sphere { pigment { gradient y color_map { [0 rgb 0.2] [1 rgb <0.4, 0.7, 1>] } } }
#macro Ball(X) sphere { X, 0.8 interior { ior 1.5 } pigment { rgb 0.3 } finish { diffuse 0.3 #end
Ball(<-2, 1, 0>) reflection 0.8 fresnel 1 } }
Ball(<0, 1, 0>) reflection { 0.1, 0.8 } fresnel 0.5 } }
Ball(<2, 1, 0>) fresnel 1 reflection { 0.8 } } }
Ball(<-2, -1, 0>) fresnel 1 reflection { 0.1, 0.9 fresnel off } } }
Ball(<0, -1, 0>) reflection { 0.1, 0.8 fresnel on } fresnel 0 } }
Ball(<2, -1, 0>) reflection { 0.8 fresnel on } fresnel 0 } }
