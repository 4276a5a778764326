// A negative light that fog does not attenuate.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,1,-5> look_at 0 }
light_source { <4,6,-4>, 0.8 media_attenuation on }
light_source { <-2,3,-3>, rgb <-0.3,-0.2,-0.1> media_attenuation on }
plane { y, -1.2 pigment { checker rgb 1 rgb 0.7 } }
sphere { 0, 1 pigment { rgb <1,0.8,0.6> } }
fog { distance 12 rgb <0.5,0.6,0.7> }
