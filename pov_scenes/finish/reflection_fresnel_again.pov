// A `reflection` without braces keeps `fresnel` of a declared finish, and reflects at normal incidence too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Two = finish { reflection { 0.2, 0.8 fresnel on } }
#declare One = finish { reflection { 0.8 fresnel on } }
sphere { <-1.1, 0, 0>, 0.9 pigment { rgb <0.1, 0.1, 0.2> } finish { Two reflection 0.5 } interior { ior 1.5 } }
sphere { <1.1, 0, 0>, 0.9 pigment { rgb <0.1, 0.1, 0.2> } finish { One reflection 0.5 } interior { ior 2.4 } }
