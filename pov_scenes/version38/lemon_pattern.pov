// Patterns and normals on a lemon that is scaled and sheared.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
lemon { -1.5*y, 0.2, 1.5*y, 0.4, 2.2 pigment { checker rgb 1 rgb <0.8, 0.2, 0.1> scale 0.3 } normal { bumps 0.4 scale 0.1 } scale <1.5, 1, 0.7> matrix <1, 0.3, 0, 0, 1, 0.2, 0, 0, 1, 0, 0, 0> }
