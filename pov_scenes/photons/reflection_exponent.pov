// Mirrors with an exponent, and coloured glass that disperses photons or keeps them in.
// compare: channel<=37 pixels<=0.011% because "two pixels lie on borders where POV-Ray's search of the map begins to miss a bright photon; around them all are equal"
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, <.9,.6,.3> }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <-1.9,.7,-.3>, .6 pigment { rgb .1 } finish { ambient 0 diffuse .1 reflection .7 reflection_exponent .5 } photons { target reflection on refraction off } }
box { <-.9,.1,.6>, <.4,1.5,.7> pigment { rgb <.8,.6,.4> } finish { ambient 0 diffuse .1 reflection { .7 metallic } reflection_exponent 1.6 }
  photons { target reflection on refraction off } }
box { -.5, .5 rotate 20*z translate <1.7,.9,0> pigment { rgbf <1,.5,.25,1> } interior { ior 1.9 dispersion 1.05 dispersion_samples 3 }
  photons { target refraction on } }
