// Objects behind the target pass photons on only where they or the light say so.
// compare: channel<=110 pixels<=0.1% because "single pixels at the edges of a shadow and of the box"
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.06 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1  } interior { ior 1.5  }
  photons { target refraction on } }
box { <-2.5,.1,-1>, <-1.4,.3,1> pigment { rgbf <1,.6,.4,.9> } interior { ior 1.2 } }
box { <-1.3,.1,-1>, <-.6,.3,1> pigment { rgbf <.4,.6,1,.9> } interior { ior 1.2 } photons { refraction on } }
