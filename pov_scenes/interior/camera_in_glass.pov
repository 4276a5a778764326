// A camera inside glass starts within its interior.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -0.4> look_at <0.2, -0.2, 3> angle 70 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1 pigment { rgbf <0.9, 1, 1, 0.95> } interior { ior 1.4 } }
sphere { <0.4, 0, 3>, 0.8 pigment { rgb <0.9, 0.5, 0.2> } }
