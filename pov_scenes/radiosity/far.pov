// Rays of radiosity do not see surfaces farther away than 1e7, nor do rays of the camera: here half of a bright plane.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 40 recursion_limit 1 } }
camera { location <0, 1.5e6, -2e6> look_at <0, 1.4e6, 0> angle 50 }
background { rgb <0.05, 0.1, 0.3> }
plane { y, 0 pigment { rgb <0.9, 0.5, 0.2> } finish { emission 1 diffuse 0 } }
sphere { <-4e5, 1.4e6, 0>, 3e5 pigment { rgb 1 } finish { diffuse 0.9 } }
box { <1e5, 1.1e6, -3e5>, <7e5, 1.6e6, 3e5> pigment { rgb <0.7, 1, 0.8> } finish { diffuse 0.9 } rotate 20*y }
