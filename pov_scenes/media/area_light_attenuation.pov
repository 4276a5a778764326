// Media of the atmosphere that attenuate an area light once, behind the last surface on its shadow rays
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -9> look_at <0, 0.6, 0> angle 40 }
media { absorption <0.03, 0.04, 0.06> method 3 samples 3, 3 intervals 1 }
light_source { <-8, 12, -6>, rgb <2.4, 1.9, 1.6> area_light <3, 0, 1>, <0, 2, 0>, 3, 3 adaptive 1 media_attenuation on }
light_source { <6, 8, -9>, rgb <0.9, 1.2, 2> area_light <2, 0, 1>, <0, 3, 0>, 4, 2 media_attenuation on }
plane { y, 0 pigment { checker rgb 1, rgb 0.6 } }
sphere { <0.9, 0.8, 0.3>, 0.8 pigment { rgb 0.9 } finish { phong 0.6 } }
