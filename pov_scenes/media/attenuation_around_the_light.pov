// Light in a ball of glass that media of the atmosphere attenuate up to the last surface on its way alone.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,2,-5> look_at 0 angle 50 }
light_source { <0.5,1.6,-2>, 1.5 media_attenuation on }
plane { y, -1.3 hollow pigment { rgb 1 } }
sphere { <0.4,1.2,-1>, 2.4 pigment { rgbt <0.9,0.9,1,0.9> } }
sphere { <-0.4,0.2,-0.3>, 0.5 pigment { rgbt <0.5,0.9,0.4,0.5> } }
media { absorption 0.1 }
