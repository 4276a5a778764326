// A lemon of glass in motion: scaled unevenly, sheared light through both sides.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { y, -1.8 pigment { checker rgb 1 rgb <0.2, 0.3, 0.8> } }
lemon { -1.2*y, 0.3, 1.2*y, 0.2, 2 pigment { rgbf <0.9, 1, 0.9, 0.9> } finish { specular 0.5 } interior { ior 1.4 } scale <1.4, 1, 0.8> rotate <10, 20, 30> }
