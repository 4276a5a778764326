// Below quality 9 a finish with subsurface light is drawn like any other.
// switches: +Q8
#version 3.7;
global_settings { assumed_gamma 1 subsurface { samples 20, 20 } }
camera { location <0, 1, -4> look_at 0 angle 42 }
background { rgb .1 }
light_source { <3, 5, -6>, rgb <.5, .4, .3> }
light_source { <-9, 1, 2>, rgb <.5, .1, .7> }
sphere { 0, 1 pigment { rgb <.9, .6, .3> } finish { ambient .05 diffuse 1 subsurface { translucency <1.1, .8, .5> } } interior { ior 1.4 } }
