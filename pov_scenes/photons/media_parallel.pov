// Parallel light through a ball into mist.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.08 media 20, 1 radius .3, 1, .3, 1 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1.2 parallel point_at <0,1.2,0> }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.6,0>, .8 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } interior { ior 1.5 } photons { target refraction on } }
box { <-3,.01,-2>, <3,.7,2> hollow pigment { rgbt 1 } photons { pass_through refraction on } interior { media { scattering { 1, .1 } method 3 samples 6 intervals 1 } } }
