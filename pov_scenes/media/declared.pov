// Media: a copy moves only the densities that it had.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
plane { y, -1.07 hollow pigment { checker rgb 0.8 rgb 0.5 } }
#declare M = media { emission 0.3 density { spherical } }
sphere { 0, 1 hollow pigment { rgbt 1 } interior { media { M } media { M emission 0.1 scale 0.5 } } rotate 30*x }
