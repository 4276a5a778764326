// Media: ratio gives lit and unlit parts their intervals.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
plane { y, -1.07 hollow pigment { checker rgb 0.8 rgb 0.5 } }
light_source { <-2, 3, -1> rgb 2 spotlight point_at <0, -1, 0> radius 10 falloff 15 }
media { scattering { 1, 0.1 } intervals 3 ratio 0.5 density { bozo } }
