// A `#default` in version 3.8 keeps the white pigment and ambient 0 for what follows in 3.7.
#version 3.8;
global_settings { assumed_gamma 1 }
#default { finish { phong 0.5 } }
#version 3.7;
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { -1.5*x, 1 pigment { rgb <1, 0.5, 0.2> } }
sphere { 1.5*x, 1 }
