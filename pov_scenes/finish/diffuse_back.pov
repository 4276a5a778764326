// A second number after `diffuse` lights the side that is turned away from the lamp.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <2, 3, 6>, rgb 1 }
triangle { <-2, -1, 0>, <-0.2, -1, 0>, <-1.1, 1, 0> pigment { rgb <0.9, 0.8, 0.4> } finish { diffuse 0.6 } }
triangle { <0.2, -1, 0>, <2, -1, 0>, <1.1, 1, 0> pigment { rgb <0.9, 0.8, 0.4> } finish { diffuse 0.6, 0.5 phong 1 } }
