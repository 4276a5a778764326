// The gamma of pictures of heights: it decodes samples, not the indices of a palette; `premultiplied` has no effect.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 3, -2.5> look_at <1.5, 0, 1> angle 60 }
light_source { <-3, 6, -4>, rgb 1 }
#macro Field(X, Z, Colour)
  scale <0.9, 0.5, 0.9> translate <X, 0, Z> pigment { rgb Colour }
#end
height_field { png "heights/grey.png" gamma 2.2 Field(0, 0, <0.9, 0.8, 0.6>) }
height_field { png "heights/deep.png" gamma 0.5 Field(1, 0, <0.6, 0.8, 0.9>) }
height_field { png "heights/colour.png" gamma srgb Field(2, 0, <0.7, 0.9, 0.6>) }
height_field { tga "heights/grey.tga" premultiplied on gamma 1.8 Field(0, 1, <0.6, 0.8, 0.9>) }
height_field { gif "heights/palette.gif" gamma 2.2 Field(1, 1, <0.7, 0.9, 0.6>) }
height_field { pgm "heights/grey.pgm" gamma 1 Field(2, 1, <0.9, 0.8, 0.6>) }
