// Media: densities by a pattern, one of them a pattern itself.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
plane { y, -1.07 hollow pigment { checker rgb 0.8 rgb 0.5 } }
box { -0.9, 0.9 hollow pigment { rgbt 1 } interior { media { emission 0.8 density { gradient y density_map { [0 rgb 0] [0.5 spherical] [1 rgb <1, 0.3, 0.2>] } scale 2 translate -1 } } } }
