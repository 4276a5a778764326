// Glass that reflects and conserves energy passes less light on, even where it reflects no photons.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <-1.2,.9,0>, .8 pigment { rgbt <1,.9,.7,.9> } finish { ambient 0 diffuse .1 reflection .5 conserve_energy }
  interior { ior 1.5 } photons { target refraction on reflection off } }
sphere { <1.2,.9,0>, .8 pigment { rgbf <.7,.9,1,.9> } finish { ambient 0 diffuse .1 reflection { .1, .6 fresnel } conserve_energy }
  interior { ior 1.5 } photons { target refraction on reflection on } }
