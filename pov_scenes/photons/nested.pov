// A ball of air within a ball of glass, and a ball of water beside it.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
difference { sphere { <-.4,1.2,0>, 1 } sphere { <-.3,1.3,0>, .6 } pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } interior { ior 1.5 }
  photons { target refraction on } }
sphere { <1.4,.6,-.3>, .6 pigment { rgbf <.8,.9,1,.9> } finish { ambient 0 diffuse .1 } interior { ior 1.33 } photons { target refraction on } }
