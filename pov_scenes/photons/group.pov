// A light of a group shoots no photons.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.05 radius .3 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, .6 }
light_group { light_source { <-3,8,-2>, .6 } sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } interior { ior 1.5 } photons { target refraction on } }
  plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } } global_lights on }
