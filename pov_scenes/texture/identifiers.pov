// Declared pigments, finishes and textures are used and changed without changing the declaration.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare P = pigment { rgb <0.9, 0.6, 0.2> };
#declare N = finish { phong 0.8 phong_size 20 };
#declare T = texture { pigment { P } finish { N } };
sphere { <-1.6, 0, 0>, 0.6 texture { T } }
sphere { <-0.2, 0, 0>, 0.6 texture { T pigment { rgb <0.3, 0.7, 0.9> } } }
sphere { <1.2, 0, 0>, 0.6 texture { T finish { N ambient 0.4 phong_size 90 } } }
sphere { <2.2, 0.9, 1>, 0.4 pigment { P } finish { N } }
