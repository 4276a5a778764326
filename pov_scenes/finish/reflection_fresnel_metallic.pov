// A Fresnel reflection is dropped or followed by its strength before metal takes its part away.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 2.2, -5> look_at 0 angle 45 }
light_source { <5, 8, -6>, rgb 1 }
background { rgb 20 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Ball = sphere { 0, 0.8 pigment { rgb 0 } }
object { Ball finish { ambient 0 reflection { 0.01, 0.012 fresnel on metallic 0.9 } } translate -0.9 * x }
object { Ball finish { ambient 0 reflection { 0.003, 0.9 fresnel on metallic 0.9 } } interior { ior 1.3 } translate 0.9 * x }
