// Targets within a union, and a combination as one target.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .8 spacing 0.07 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
union { sphere { <-1.3,.8,0>, .6 photons { target refraction on } } sphere { <-.2,.5,1.2>, .4 }
  pigment { rgbt <1,1,1,.9> } interior { ior 1.5 } rotate 10*y }
difference { sphere { <1,.9,0>, .8 } sphere { <1,1.6,0>, .7 }
  pigment { rgbt <1,1,1,.9> } interior { ior 1.5 } photons { target refraction on reflection off } }
