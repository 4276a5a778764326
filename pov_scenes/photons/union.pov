// Photons aim at each part of a union, but at a union that is not split as a whole.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
#declare Clear = texture { pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } }
union { sphere { <-2,.7,.4>, .5 } union { sphere { <0,.6,-.8>, .4 } sphere { <.2,.8,1.6>, .5 } }
  texture { Clear } interior { ior 1.5 } photons { target refraction on } }
union { sphere { <1.4,.7,0>, .4 } sphere { <2.2,.6,.9>, .4 } split_union off
  texture { Clear } interior { ior 1.5 } photons { target refraction on } }
