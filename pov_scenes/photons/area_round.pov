// Photons of an area light start from its rectangle, even if it is circular and turns to the point it lights.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.08 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 area_light 2*x, 2*z, 3, 3 circular orient photons { area_light refraction on } }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } interior { ior 1.5 }
  photons { target refraction on } }
