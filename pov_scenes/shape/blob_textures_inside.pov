// Blobs whose components have textures look from inside as from outside, `interior_texture` or not; others do not.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare In = texture { pigment { rgb <1, 0, 1> } }
blob { threshold 0.2 sphere { -0.5*x, 1.2, 1 pigment { rgb <1, 0, 0> } } sphere { 0.5*x, 1.2, 1 } pigment { rgb <1, 1, 0> } interior_texture { In } clipped_by { plane { -z, 0.2 } } translate -1.6*x }
blob { threshold 0.2 sphere { -0.5*x, 1.2, 1 } sphere { 0.5*x, 1.2, 1 } pigment { rgb <1, 1, 0> } interior_texture { In } clipped_by { plane { -z, 0.2 } } translate 1.6*x }
