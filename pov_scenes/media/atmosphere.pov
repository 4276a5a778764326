// Media: the atmosphere glows and swallows light; fog lies before it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
plane { y, -1.07 hollow pigment { checker rgb 0.8 rgb 0.5 } }
fog { distance 30 rgb 0.7 }
media { emission 0.02 absorption 0.01 }
sphere { 0, 0.7 pigment { rgb x } }
