// Subsurface light: a slab thin against the free path of light, lit from both sides, and beams through it.
// compare: channel<=12 pixels<=0.2% because "shadow rays of POV-Ray miss their own body within 1e-3 of an edge, unless it blocked the ray before"
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 20 subsurface { samples 10, 10 } }
camera { location <1, 1.5, -3> look_at 0 angle 45 }
light_source { <3, 5, -6>, rgb .3 }
light_source { <-.5, 1, 3>, rgb <.6, .5, .3> spotlight point_at <.2, .1, 0> radius 6 falloff 12 }
box { <-1, -.8, 0>, <1, .8, .05> pigment { rgb <.9, .7, .4> } finish { subsurface { translucency <1, .8, .5> } } interior { ior 1.4 } }
