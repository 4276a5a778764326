// Subsurface light of two layers, of blended textures, and with bumps, which it ignores.
#version 3.7;
global_settings { assumed_gamma 1 subsurface { samples 8, 8 } }
camera { location <0, 0, -6> look_at 0 angle 38 }
light_source { <3, 5, -6>, rgb .5 }
#declare Amber = texture { pigment { rgb <.9, .6, .3> } finish { ambient 0 diffuse 1 subsurface { translucency <1.1, .8, .5> } } }
#declare Jade = texture { pigment { rgb <.3, .8, .7> transmit .25 } finish { ambient .1 diffuse .8 phong .4 subsurface { translucency <4, 5, 3> } } }
sphere { <-1.1, .6, 0>, 1 texture { Amber } texture { Jade } interior { ior 1.4 } }
sphere { <1.1, .6, 0>, 1 texture { gradient x texture_map { [.3 Amber] [.7 Jade] } scale 2 } interior { ior 1.4 } }
sphere { <0, -1.2, -.5>, .7 texture { Amber normal { bumps .8 scale .1 } finish { specular .5 } } interior { ior 1.4 } }
