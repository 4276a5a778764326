// Radiosity in a room lit by lamps that are moved at random.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 30 error_bound 0.9 recursion_limit 2 } }
camera { location <0, 1, -2.9> look_at 0.8*y angle 60 }
light_source { <0, 1.8, -0.5>, rgb 0.8 area_light 0.6*x, 0.6*z, 4, 4 adaptive 1 jitter }
#default { finish { ambient 0 diffuse 0.7 } }
box { <-1.5, 0, -3>, <1.5, 2, 1.5> pigment { rgb 0.9 } hollow }
box { <-1, -0.1, 0>, <-0.3, 1.1, 0.6> pigment { rgb <0.9, 0.2, 0.1> } rotate 10*y }
sphere { <0.6, 0.5, -0.2>, 0.4 pigment { rgb <0.8, 1, 0.8> } finish { reflection 0.2 } }
