// Shadowless lights do not shine on media: nothing is scattered, and their beams do not divide the way of a ray.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 angle 45 }
light_source { <-3, 6, -2>, rgb <0.9, 0.8, 0.6> }
light_source { <4, 3, -2>, rgb <0.5, 0.9, 1.5> shadowless }
background { rgb <0.2, 0.3, 0.4> }
plane { y, -1.4 hollow pigment { rgb 0.7 } }
#default { pigment { rgbt 1 } }
sphere { <-1.2, 0, 0>, 1.1 hollow interior { media { scattering { 1, 0.6 } density { spherical } } } }
box { <0.3, -1, -0.8>, <2.2, 0.9, 0.8> hollow interior { media { intervals 3 ratio 0.7 scattering { 3, <0.4, 0.3, 0.2> } density { bozo scale 0.6 } } } rotate 20*y }
