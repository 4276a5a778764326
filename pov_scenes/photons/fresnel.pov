// Glass that mirrors as Fresnel has it, in a colour; highlights of photons.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.06 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb <.8,.9,1> } finish { ambient 0.05 diffuse .6 specular .4 phong .3 } }
sphere { <0,1.2,0>, 1 pigment { rgbf <1,.7,.5,.9> } finish { ambient 0 diffuse .1 reflection { 0, 1 fresnel } conserve_energy } interior { ior 1.5  }
  photons { target refraction on reflection on } }
