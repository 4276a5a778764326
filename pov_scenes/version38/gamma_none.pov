// A scene of version 3.8 without `assumed_gamma` computes in linear colours.
#version 3.8;
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } finish { ambient 0.1 } }
background { rgb <0.1, 0.2, 0.3> }
