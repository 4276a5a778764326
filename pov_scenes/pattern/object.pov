// `object` with its own colours, colours and pigments.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Bar = torus { 0.7, 0.25 rotate 70*x translate <0.8, -0.2, 0> }
plane { -z, -1 pigment { object { sphere { 0, 1 translate 0.5*z } } } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { object { Bar rgb 1, rgb <1, 0, 0> } turbulence 0.1 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { object { union { sphere { 0, 0.3 } box { <-0.1, -1, -1>, <0.1, 1, 1> } translate -0.8*x } pigment { checker scale 0.1 } pigment { rgb <1, 0.8, 0> } } } }
