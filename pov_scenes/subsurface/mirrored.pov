// Subsurface light in a mirror and through glass, of bodies behind each other.
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 25 max_trace_level 8 subsurface { samples 8, 5 } }
camera { location <0, 2, -5> look_at <0, .6, 0> angle 45 }
light_source { <4, 6, -4>, rgb 1 }
plane { y, 0 pigment { rgb .4 } finish { reflection .4 } }
sphere { <-.9, .9, 1>, .8 pigment { rgb <.9, .7, .6> } finish { subsurface { translucency <4, 2, 1> } } interior { ior 1.33 } }
sphere { <.5, .8, -.6>, .6 pigment { rgbf <1, 1, 1, .9> } finish { reflection { .05, .4 } } interior { ior 1.5 } }
box { <.8, .05, .5>, <1.7, 1.2, 1.2> pigment { rgb <.6, .7, .95> } finish { subsurface { translucency <1, 2, 4> } reflection .1 } interior { ior 1.4 } }
