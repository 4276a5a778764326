// A ray that meets nothing is untouched by the media of what it is in, be it a half-space or a tube it leaves by the open end; the
// media of the atmosphere take light from it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 angle 50 }
light_source { <5, 8, -9>, rgb 1 }
media { absorption rgb <0, 0, 0.5e-10> }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.2, 0.3, 0.5>] [1 rgb <0.6, 0.8, 1>] } } }
plane { -z, -2 hollow pigment { rgbt 1 } interior { media { emission rgb <0.1, 0.05, 0> scattering { 1, rgb 0.05 } } } }
cylinder { -y, y, 1 open hollow pigment { rgbt 1 } interior { media { absorption 0.7 } } rotate <60, 20, 0> translate -1.5*x }
sphere { <1.5, 0, 6>, 1.5 pigment { rgb <1, 0.8, 0.5> } finish { reflection 0.4 } }
