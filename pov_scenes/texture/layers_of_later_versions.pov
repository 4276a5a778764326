// Upper layers that a later version declared transmit instead of filtering in an object, a material and a declaration
// of version 3.1.
#version 3.5;
camera { location <0, 1, -5> look_at 0 }
light_source { <-3, 5, -6>, 1 }
#declare Layers = texture { pigment { rgb <1, 0.6, 0.3> } } texture { pigment { checker rgbf <0.3, 1, 0.6, 0.7> rgbt <0, 1, 1, 0.5> scale 0.4 } };
#declare Stuff = material { texture { Layers } };
#version 3.1;
#declare Again = texture { Layers }
sphere { -2*x, 0.9 texture { Layers } }
sphere { 0, 0.9 material { Stuff } }
sphere { 2*x, 0.9 texture { Again } }
