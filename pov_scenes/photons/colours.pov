// Coloured glass in layers of light: filter, fading, a pattern.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { checker rgbf <1,.3,.2,.95> rgbf <.4,1,.5,.9> scale .6 } finish { ambient 0 diffuse .1  } interior { ior 1.5 fade_distance 2 fade_power 1 fade_color <.6,.8,1> }
  photons { target refraction on } }
