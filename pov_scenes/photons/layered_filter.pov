// Layers of coloured glass: an upper one colours what the lower ones filter and mirror.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
#declare Glass = finish { ambient 0 diffuse .1 }
sphere { <-1.3,.9,0>, .7 texture { pigment { rgbf <1,.6,.9,.9> } finish { Glass } } texture { pigment { rgbft <.9,.8,.5,.7,.2> } finish { Glass } }
  texture { pigment { rgbf <.9,1,.7,1> } finish { Glass } } interior { ior 1.4 } photons { target refraction on } }
box { <.3,.2,.5>, <1.9,1.6,.6> rotate -15*x texture { pigment { rgb <.9,.7,.5> } finish { Glass reflection { .7 metallic } } }
  texture { pigment { rgbf <.7,.8,1,.9> } finish { Glass } } photons { target reflection on refraction off } }
