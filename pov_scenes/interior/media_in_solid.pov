// Media in an object that is not hollow are not seen.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sphere { <0, 1, 0>, 1 pigment { rgbt <1, 1, 1, 0.8> } interior { ior 1.2 media { emission 1 density { spherical density_map { [0 rgb 0] [1 rgb <1, 0.5, 0>] } translate y } scattering { 5, 0.3 eccentricity 0.2 } samples 3, 9 } } }
