// `ior 0` is as no `ior` at all: light goes straight, and what is around or within bends it by its own.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0, 1, -6> look_at 0 angle 45 }
light_source { <-5, 8, -9>, 0.8 }
plane { y, -1.2 pigment { checker rgb 0.9 rgb <0.3, 0.5, 0.9> } }
plane { -z, -6 pigment { checker rgb <0.9, 0.4, 0.2> rgb 0.2 } }
#default { pigment { rgbf <0.98, 0.98, 0.99, 0.7> } finish { diffuse 0.1 } }
#declare Glass = interior { ior 1.5 }
sphere { <-1.6, 0.1, 0>, 0.7 interior { ior 0 } }
sphere { <0, 0.1, 0>, 0.8 interior { Glass } }
sphere { <0.3, 0.1, 0>, 0.45 interior { Glass ior 0 } }
sphere { <1.7, 0.1, 0>, 0.7 finish { ior 0 reflection { 0, 1 fresnel } } }
