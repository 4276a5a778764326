// In the air around everything photons are neither left nor swallowed.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.06 media 60, 2  } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,6,-2>, 2 spotlight point_at <0,1.2,0> radius 8 falloff 12 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1  } interior { ior 1.5  }
  photons { target refraction on } }
media { scattering { 3, .06 } method 3 samples 6 intervals 1 }
