// A number behind the name of a normal is its amount.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
#declare Rough = normal { bumps 1 scale 0.2 }

sphere { -1.2*x, 1 pigment { rgb 1 } normal { Rough 0.2 } }
sphere { 1.2*x, 1 pigment { rgb 1 } normal { Rough 3 turbulence 0.2 } }
