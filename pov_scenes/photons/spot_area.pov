// A spotlight of nine lamps that all shoot.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.1 radius .5 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1.4 spotlight point_at <0,1,0> radius 6 falloff 12 area_light x*.8, z*.8, 3, 3 photons { area_light refraction on reflection on } }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.8> } finish { ambient 0 diffuse .1 reflection .15 } interior { ior 1.5 } photons { target } }
