// `gamma` overrules what the file says.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { image_map { "images/rgb.png" gamma 1 } scale 2 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { image_map { "images/gamma18.png" gamma srgb } rotate 40*y } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { image_map { "images/rgb.ppm" gamma 2.2 } } }
