// Two lights and two targets with spacings of their own.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.08 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, .6 }
light_source { <-4,6,-3>, <.6,.4,.3> }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <-1,.8,0>, .7 pigment { rgbt <1,1,1,.9> } interior { ior 1.5 } photons { target .7 refraction on } }
sphere { <1,.8,0>, .7 pigment { rgb .5 } finish { diffuse .2 reflection .7 } photons { target 1.3 reflection on refraction off } }
