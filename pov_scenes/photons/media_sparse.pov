// Where no photon falls into an interval of media, those behind it carry no light.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4,1,.3 spacing 0.08 media 5, 12 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1.2 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1  } interior { ior 1.5  }
  photons { target refraction on } }
box { <-3,.01,-2>, <3,.8,2> hollow pigment { rgbt 1 } photons { pass_through refraction on }
  interior { media { scattering { 1, .08 } method 3 samples 8 intervals 1 } } }
