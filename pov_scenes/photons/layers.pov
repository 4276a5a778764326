// Photons on layers and on a texture map.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.06 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 texture { checker texture { pigment { rgb <1,.9,.6> } } texture { pigment { rgb <.6,.8,1> } finish { diffuse .4 specular .6 } } }
  }
box { <-2.5,0,-1>, <-.3,.15,1> texture { pigment { rgb 1 } } texture { pigment { rgbt <1,0,0,.6> } normal { ripples .4 scale .2 } finish { phong .7 } } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1  } interior { ior 1.5  }
  photons { target refraction on } }
