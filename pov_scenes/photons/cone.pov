// Glass cones and a cylinder; photons aim at the boxes of their untransformed shapes.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.06 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
#declare Clear = texture { pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } }
cone { <-1.7,.1,.2>, .7, <-1.6,1.3,.3>, .3 texture { Clear } interior { ior 1.4 } photons { target refraction on } }
cone { <.1,.1,-.3>, .2, <.1,1.2,-.1>, .6 texture { Clear } interior { ior 1.4 } photons { target refraction on } }
sphere { 0, .6 scale <1,.7,.8> rotate 20*z translate <1.7,.6,.2> texture { Clear } interior { ior 1.4 } photons { target refraction on } }
