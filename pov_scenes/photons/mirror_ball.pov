// A mirror ball: photons from its upper half.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <.2,1.1,-.3>, .8 pigment { rgb .2 } finish { ambient 0 diffuse .1 reflection .8 } photons { target reflection on refraction off } }
