// The default finish: ambient 0.1 and diffuse 0.6.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
sphere { 0, 1.4 pigment { rgb 1 } }
