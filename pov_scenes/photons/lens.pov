// A lens cut from two balls, on a chequered floor.
#version 3.7;
global_settings { assumed_gamma 1 photons { count 6000 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <1,9,-1.5>, 1.2 }
plane { y, 0 pigment { checker rgb .9 rgb <.5,.6,.8> scale .5 } finish { ambient 0.05 diffuse .8 } }
intersection { sphere { <0,-1.2,0>, 2 } sphere { <0,1.6,0>, 1.8 } translate <.1,1.2,.2> pigment { rgbt <1,1,1,.95> }
  finish { ambient 0 diffuse .05 specular .4 } interior { ior 1.6 } photons { target refraction on reflection off } }
