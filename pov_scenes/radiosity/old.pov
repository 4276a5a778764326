// Radiosity: before version 3.7 ambient light is added to what is gathered.
#version 3.6;
global_settings { assumed_gamma 1 radiosity { count 40 } }
background { rgb .5 }
camera { location <0, 2, -6> look_at <0, 1, 0> }
plane { y, 0 pigment { rgb <.8, .6, .4> } finish { ambient .3 diffuse .7 } }
box { <1, 0, 0>, <2, 2, 1> pigment { rgb <1, .2, .2> } finish { ambient .3 diffuse albedo .5 brilliance 3 } }
sphere { <-1, 1, 0>, 1 pigment { rgb 1 } finish { ambient 0 diffuse .5 } }
