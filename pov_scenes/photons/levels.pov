// The depth of bent and mirrored photons: max_trace_level and adc_bailout of their own.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.06 max_trace_level 3 adc_bailout .2 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 reflection .3 } interior { ior 1.5  }
  photons { target refraction on reflection on } }
sphere { <1.6,.5,-.6>, .5 pigment { rgbt <1,1,1,.9> } finish { reflection .15 } interior { ior 1.5 } photons { refraction on reflection on } }
