// Subsurface light in a mesh, a blob and a cylinder.
// compare: channel<=12 pixels<=0.2% because "shadow rays of POV-Ray miss their own body within 1e-3 of an edge, unless it blocked the ray before"
#version 3.7;
global_settings { assumed_gamma 1 subsurface { samples 12, 8 } }
camera { location <1, 3, -7> look_at <0, .5, 0> angle 32 }
light_source { <6, 9, -5>, rgb .9 }
plane { y, -.3 pigment { rgb .5 } }
blob { threshold .6 sphere { <-1.3, .5, 0>, 1, 1 } sphere { <-.4, .6, .3>, .9, 1 } pigment { rgb <.9, .7, .6> } finish { subsurface { translucency <1.5, .8, .4> } } interior { ior 1.4 } }
mesh {
  triangle { <.6, 0, -1>, <1.6, 0, -1>, <1.1, 1.4, -.6> } triangle { <1.6, 0, -1>, <1.2, 0, 0>, <1.1, 1.4, -.6> }
  triangle { <1.2, 0, 0>, <.6, 0, -1>, <1.1, 1.4, -.6> } triangle { <.6, 0, -1>, <1.6, 0, -1>, <1.2, 0, 0> }
  pigment { rgb <.5, .8, .6> } finish { subsurface { translucency <.5, 1.5, .7> } } interior { ior 1.3 }
}
cylinder { <-.2, 0, -1.2>, <.2, .8, -1>, .25 pigment { rgb <.9, .8, .8> } finish { subsurface { translucency <.4, .2, .1> } } }
