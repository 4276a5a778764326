// Superellipsoids with a negative first exponent: open surfaces; and one that shows nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -8> look_at 0 right 6*x up 4.5*y }
light_source { <4, 6, -6>, 1 }
background { rgb 0.3 }
#default { finish { ambient 0.3 } }
superellipsoid { <-1, 1> pigment { rgb <1, 0.5, 0.2> } translate <-1.5, 1.1, 0> }
superellipsoid { <-2, 0.3> pigment { rgb <0.5, 1, 0.2> } translate <1.5, 1.1, 0> }
superellipsoid { <1, -0.5> pigment { rgb 1 } translate <1.5, -1.1, 0> }
