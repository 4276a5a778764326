// Reflection of the lower or upper of two layers where glass reflects totally, with bumps on either.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,0.5,-6> look_at 0 angle 50 }
light_source { <-4,6,-8>, 1 }
plane { y, -2 pigment { checker rgb <0.9,0.8,0.6>, rgb <0.2,0.3,0.4> } }
plane { z, 9 pigment { checker rgb <0.2,0.8,0.9>, rgb <0.6,0.3,0.4> } }
#default { pigment { rgbt <0.9,0.9,0.9,0.9> } }
#declare Bumps = normal { bumps 0.4 scale 0.2 }
#declare Mirror = finish { reflection 0.3 }
#declare Glass = interior { ior 1.46 }
sphere { <-1.5,0.9,0>, 0.8 texture { normal { Bumps } finish { Mirror } } texture { } interior { Glass } }
sphere { <0.3,0.9,0>, 0.8 texture { finish { Mirror } } texture { normal { Bumps } } interior { Glass } }
sphere { <2,0.9,0>, 0.8 texture { normal { Bumps } } texture { finish { Mirror } } interior { Glass } }
sphere { <-1.5,-0.9,0>, 0.8 texture { finish { Mirror } } texture { normal { Bumps } finish { Mirror } } interior { Glass } }
sphere { <0.3,-0.9,0>, 0.8 texture { normal { Bumps } finish { Mirror } } texture { normal { Bumps } } interior { Glass } }
