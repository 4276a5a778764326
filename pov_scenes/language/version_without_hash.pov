// `version` between objects, without `#`, is the directive.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
version 3.1
sphere { 0, 1 pigment { #if (version < 3.5) color red 1 #else color blue 1 #end } }
version 3.7
plane { y, -1.2 pigment { #if (version < 3.5) color red 1 #else color green 0.6 #end } }
