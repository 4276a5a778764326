// Media: a flame in a cone.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
plane { y, -1.07 hollow pigment { checker rgb 0.8 rgb 0.5 } }
cone { <0, -1, 0>, 0.8, <0, 1, 0>, 0.1 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { emission 2 intervals 10 samples 3 density { cylindrical turbulence 0.3 color_map { [0 rgb 0] [0.5 rgb <1, 0.3, 0>] [1 rgb 1] } } } } }
