// A ray from the camera does not start within an inverse solid whose box it is not in.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 2.5, -5> look_at 0 angle 34 }
light_source { <5, 8, -6>, rgb 1 }
background { rgb 0.3 }
plane { y, -1.4 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1 inverse pigment { rgbt <0.8, 0.9, 1, 0.6> } interior { ior 1.3 } }
