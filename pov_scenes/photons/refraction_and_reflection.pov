// A glass ball that mirrors: both ways of each photon.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 reflection .2 } interior { ior 1.5  }
  photons { target refraction on reflection on } }
