// All layers of a texture mirror photons about the normal of the lowest one.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
#declare Rough = texture { pigment { rgbt <1,.6,.4,.8> } normal { gradient x .5 scale .5 } finish { ambient 0 diffuse .1 } }
#declare Mirror = texture { pigment { rgbt <.6,.8,1,.7> } finish { ambient 0 diffuse .1 reflection .6 } }
box { <-1.9,.2,.5>, <-.3,1.6,.6> rotate -15*x texture { Mirror } texture { Rough } photons { target reflection on } }
box { <.3,.2,.5>, <1.9,1.6,.6> rotate -15*x texture { Rough } texture { Mirror } photons { target reflection on } }
