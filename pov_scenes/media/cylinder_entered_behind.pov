// Few samples of media in the beam of a cylinder light that rays enter behind the light.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,3,-5> look_at 0 angle 45 }
light_source { <0.5,1.6,-2>, 1 cylinder point_at -y radius 0.4 falloff 1.57 }
plane { y, -2 hollow pigment { rgb 0.8 } }
media { scattering { 1, 0.03 } samples 5 }
