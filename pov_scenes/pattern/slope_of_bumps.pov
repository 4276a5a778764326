// A slope in a pigment sees the normal that bumps have made last, those of another layer or texture too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -9> look_at 0 angle 40 }
light_source { <3, 8, -4> rgb 1 }
#declare Glow = finish { ambient 1 diffuse 0 }
#declare Steep = pigment { slope y }
sphere { <-2, 1, 0>, 0.9 pigment { Steep } }
sphere { <0, 1, 0>, 0.9 pigment { Steep } normal { bumps 1 scale 0.3 } }
sphere { <2, 1, 0>, 0.9 texture { pigment { Steep } finish { Glow } } texture { pigment { rgbt 1 } normal { bumps 1 scale 0.3 } finish { ambient 0 diffuse 0 } } }
sphere { <-2, -1, 0>, 0.9 texture { granite texture_map { [0 pigment { Steep } finish { Glow }] [1 pigment { rgb 0 } normal { bumps 1 } finish { Glow }] } } }
sphere { <0, -1, 0>, 0.9 texture { granite texture_map { [0 pigment { rgb 0 } normal { bumps 1 } finish { Glow }] [1 pigment { Steep } finish { Glow }] } } }
sphere { <2, -1, 0>, 0.9 texture { average texture_map { [1 pigment { rgb 0 } normal { bumps 1 } finish { Glow }] [1 pigment { Steep } finish { Glow }] } } }
