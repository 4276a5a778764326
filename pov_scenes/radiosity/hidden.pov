// Radiosity: what gathers light sees things that the camera does not, not in mirrors, and not what is hidden from it.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 40 recursion_limit 1 } }
background { rgb .5 }
camera { location <0, 2, -6> look_at <0, 1, 0> }
light_source { <5, 10, -5>, rgb .2 }
plane { y, 0 pigment { rgb <.8, .6, .4> } finish { ambient .3 diffuse .7 } }
#declare Lamp = box { <0, 0, 0>, <.7, 2, .7> pigment { rgb <1, .2, .2> } finish { diffuse .7 emission 1 } }
object { Lamp translate <1, 0, 0> no_image }
object { Lamp translate <2.2, 0, 1> no_reflection }
object { Lamp translate <-3, 0, 1> no_radiosity }
sphere { <-1, 1, 0>, 1 pigment { rgb 1 } finish { diffuse .5 ambient 1 reflection .3 } }
