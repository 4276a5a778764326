// The last digits of mirrored and bent rays and of bumped normals: the planes are black or white by the side of them on which
// rounding puts a hit.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 1, 0> angle 60 }
#declare Side = pigment { gradient y color_map { [0 rgb 0] [1 rgb 1] } scale 1000 }
#default { finish { ambient 1 diffuse 0 } }
plane { y, 4 pigment { Side translate 4 * y } }
plane { -y, 4 pigment { Side translate -4 * y } }
#declare Mirror = texture { pigment { rgb .2 } finish { reflection .8 } }
#declare Glass = material { texture { pigment { rgbf 1 } } interior { ior 1.4 } }
sphere { <-4, 1, 1>, 1 texture { Mirror } }
cylinder { <-2.5, .5, 0>, <-1, 2, 0>, .8 texture { Mirror } }
cone { <0, 0, 0>, 1, <.5, 2, 0>, .3 texture { Mirror } }
sphere { 0, 1 scale <.8, 1.2, .7> rotate 30 translate <2, 1, 0> texture { Mirror } }
quadric { <1, -1, 1>, 0, 0, 0 clipped_by { box { -1, 1 } } rotate 20 * x translate <4, 1, 1> texture { Mirror } }
disc { <-2.5, 3, 2>, <.2, 1, -.7>, 1 texture { Mirror normal { onion .6 frequency 3 sine_wave turbulence .2 scale <.5, .4, .6> } } }
box { <-.5, 2.4, 1>, <.7, 3.4, 2> rotate 10 texture { Mirror normal { quilted .5 scale .3 } } }
sphere { <2, 3, 2>, .8 texture { Mirror normal { bumps .4 scale .2 } } }
triangle { <3, 2, 2>, <5, 2, 3>, <4, 4, 2> texture { Mirror } }
sphere { <-2, -.5, -2>, .8 material { Glass } }
cylinder { <.2, -.6, -2>, <1.4, -.4, -2>, .6 material { Glass } }
