// Subsurface light in bodies of several parts: those that share an interior are one.
// compare: channel<=12 pixels<=0.2% because "shadow rays of POV-Ray miss their own body within 1e-3 of an edge, unless it blocked the ray before"
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 15 subsurface { samples 10, 8 } }
camera { location <0, 2, -6> look_at <0, .2, 0> angle 42 }
light_source { <4, 6, -4>, rgb .9 }
#declare Wax = texture { pigment { rgb <.95, .85, .6> } finish { subsurface { translucency <2, 1.4, .8> } } }
union { sphere { <-1.6, .6, 0>, .6 } box { <-1.9, -.6, -.3>, <-1.3, .3, .3> } texture { Wax } interior { ior 1.4 } }
merge { sphere { <0, .6, 0>, .6 } box { <-.3, -.6, -.3>, <.3, .3, .3> } texture { Wax } interior { ior 1.4 } }
union { sphere { <1.6, .6, 0>, .6 interior { ior 1.4 } } box { <1.3, -.6, -.3>, <1.9, .3, .3> interior { ior 1.4 } } texture { Wax } }
difference { box { <-.8, -.9, -1.6>, <.8, -.4, -1.1> } sphere { <0, -.3, -1.6>, .35 } texture { Wax } }
