// A ball of strongly dispersing glass.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.08 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } interior { ior 1.5 dispersion 1.1 dispersion_samples 7 } photons { target refraction on } }
