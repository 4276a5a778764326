// `rgbt` takes the fourth component of a colour of five as transmit, and no filter: a colour with transmit is opaque.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 } }
camera { location <0, 0, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { z, 2 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> scale 0.4 } }
#declare Clear = rgbf <1, 0.3, 0, 0.5>;
#macro Ball(C, T) sphere { C, 0.5 pigment { rgbt T } } #end
#macro Other(C, T) sphere { C, 0.5 pigment { rgbf T } } #end
Ball(<-1.3, 0.7, 0>, rgbt <1, 0.3, 0, 0.5>)
Ball(<0, 0.7, 0>, rgbft <1, 0.3, 0, 0.6, 0.3>)
Ball(<1.3, 0.7, 0>, rgbf <1, 0.3, 0, 0.5>)
Other(<-1.3, -0.7, 0>, rgbt <1, 0.3, 0, 0.5>)
Other(<0, -0.7, 0>, rgbft <1, 0.3, 0, 0.3, 0.6>)
sphere { <1.3, -0.7, 0>, 0.5 pigment { srgbt Clear * 0.8 } }
