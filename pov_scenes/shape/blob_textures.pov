// Blobs: components with pigments and textures of their own blend by their fields; others look as the blob does.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
blob { threshold 0.2 sphere { -0.5*x, 1.2, 1 pigment { rgb <1, 0, 0> } finish { phong 1 } } sphere { 0.5*x, 1.2, 1 } cylinder { -y, y, 0.5, -0.5 pigment { rgb <0, 1, 0> } } pigment { rgb <0.2, 0.3, 1> } translate <-1.6, 1.2, 0> }
blob { threshold 0.2 sphere { -0.5*x, 1.2, 1 pigment { checker rgb <1, 0, 0> rgb 1 scale 0.2 } rotate 30 scale <1, 1.1, 1> } sphere { 0.5*x, 1.2, 1 normal { bumps scale 0.1 } } pigment { rgb <0.2, 0.3, 1> } rotate 20*y translate <1.6, 1.2, 0> }
blob { threshold 0.2 sphere { -0.5*x, 1.2, 1 texture { pigment { rgb <1, 0.6, 0> } } texture { pigment { checker rgbt <0, 1, 0, 0.5> rgbt 1 scale 0.3 } } } sphere { 0.5*x, 1.2, 1 pigment { rgbf <0.4, 0.4, 1, 0.8> } finish { reflection 0.3 } } finish { specular 1 } translate <-1.6, -1.2, 0> }
blob { threshold 0.2 sphere { -0.5*x, 1.2, 1 texture { gradient y texture_map { [0 pigment { rgb <1, 0, 0> }] [1 pigment { rgb 1 } finish { ambient 1 }] } scale 0.3 } } sphere { 0.5*x, 1.2, 1 texture { uv_mapping pigment { checker scale 0.2 } } } translate <1.6, -1.2, 0> }
