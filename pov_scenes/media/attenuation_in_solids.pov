// Light that media of the atmosphere attenuate on its way through solid and hollow glass.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,2,-5> look_at 0 angle 50 }
light_source { <1,5,2>, 1.5 media_attenuation on }
plane { y, -1.3 hollow pigment { rgb 1 } }
sphere { <-1.2,0,0>, 0.8 pigment { rgbt <0.5,0.9,0.4,0.5> } }
sphere { <1.2,0,0>, 0.8 pigment { rgbt <0.9,0.5,0.4,0.5> } hollow }
media { absorption 0.1 }
