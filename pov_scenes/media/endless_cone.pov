// Thin media without end under a spotlight whose cone some rays never leave.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,0,-1> look_at 0 }
light_source { <0,3,-20>, rgb <1,2,4> spotlight point_at <0,0,2> radius 20 falloff 25 }
media { scattering { 1, 1.5e-8 } }
