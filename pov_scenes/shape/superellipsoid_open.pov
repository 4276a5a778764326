// Superellipsoids with a negative first exponent seen aslant, where they end beyond their boxes, alone, in CSG and in a union.
// compare: channel<=41 pixels<=0.03% because "POV-Ray extrapolates the surface beyond the box of 1.01 on four rays that leave it close to the surface"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -8> look_at 0 right 8*x up 6*y }
light_source { <4, 6, -6>, 1 }
background { rgb 0.3 }
#default { finish { ambient 0.3 } }
superellipsoid { <-2, 0.3> pigment { rgb <0.5, 1, 0.2> } rotate <30, -40, 0> translate <0, 1.5, 0> }
intersection { superellipsoid { <-0.5, 1.5> } sphere { 0, 0.9 } pigment { rgb <0.2, 0.5, 1> } rotate <30, 40, 0> translate <2.5, 1.5, 0> }
intersection { superellipsoid { <-1, 1> } sphere { 0, 1.2 } pigment { rgb <0.2, 0.5, 1> } rotate <-30, 40, 0> translate <-2.5, 1.5, 0> }
union { superellipsoid { <-1, 1> } sphere { 0, 0.3 } pigment { rgb <0.9, 0.5, 1> } rotate <-30, 40, 0> scale 1.1 translate <-2.5, -1.5, 0> }
union { superellipsoid { <-1, 1> } sphere { <0, 0, 1>, 0.3 } pigment { rgb <1, 0.5, 0.6> } rotate <60, 20, 0> translate <0, -1.5, 0> }
difference { sphere { 0, 1.2 } superellipsoid { <-1, 3> } pigment { rgb <0.2, 0.9, 1> } rotate <30, 40, 0> translate <2.5, -1.5, 0> }
