// Negative lights behind fading glass and absorbing media.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,1.5,-5> look_at 0 angle 60 }
light_source { <-4,6,-8>, 1 }
light_source { <2,4,-3>, rgb <-0.3,-0.2,0> }
light_source { <-3,5,2>, rgb <-0.3,-0.1,0.05> }
plane { y, -1 pigment { rgb 1 } }
sphere { <-1.5,0,0>, 0.7 pigment { rgbf <0.9,0.5,0.4,0.7> } interior { fade_distance 1 fade_power 1 } }
sphere { 0, 0.7 pigment { rgbt 1 } interior { fade_distance 1 fade_power 1001 fade_color <1,0.5,0.2> } }
sphere { <1.5,0,0>, 0.7 pigment { rgbt 1 } hollow interior { media { absorption 0.5 } } }
