// Media scatter no light of a light group, whatever is seen through them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -10> look_at 0 angle 40 }
background { rgb 0.5 }
light_source { <5, 8, -9>, rgb 0.3 }
light_group { sphere { 0, 1 pigment { rgb 0.5 } } light_source { <-3, 3, -3>, rgb 1 shadowless } global_lights on }
sphere { 0, 20 hollow pigment { rgbt 1 } interior { media { scattering { 1, 0.03 } intervals 3 samples 3, 3 method 3 } } }
