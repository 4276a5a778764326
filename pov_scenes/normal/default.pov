// Normal: entries of maps and lists begin with what #default says.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
#default { normal { bumps bump_size 1.5 } }
sphere { <-0.7, 0, 0>, 0.6 normal { gradient x normal_map { [0.3 marble turbulence 0.5] [0.7 gradient y scallop_wave scale 0.3] } } pigment { rgb 0.9 } }
sphere { <0.7, 0, 0>, 0.6 normal { checker normal { marble turbulence 0.5 } normal { radial sine_wave frequency 10 rotate 90*x } scale 0.37 } pigment { rgb 0.9 } }
