// `fresnel` of a declared finish acts on a later `reflection` of one colour.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sky_sphere { pigment { gradient y color_map { [0 rgb 0.2] [1 rgb <0.4, 0.7, 1>] } } }
#declare InBraces = finish { diffuse 0.3 reflection { 0.8 fresnel on } }
#declare InFinish = finish { diffuse 0.3 reflection 0.4 fresnel 1 }
#macro Ball(X) sphere { X, 0.8 interior { ior 1.5 } pigment { rgb 0.3 } finish { #end
Ball(<-2, 1, 0>) InBraces reflection 0.5 } }
Ball(<0, 1, 0>) InFinish reflection 0.5 } }
Ball(<2, 1, 0>) InFinish reflection { 0.5 fresnel off } } }
Ball(<-2, -1, 0>) InBraces fresnel 0 } }
Ball(<0, -1, 0>) InFinish fresnel 0 } }
Ball(<2, -1, 0>) InFinish reflection { 0.5 } } }
