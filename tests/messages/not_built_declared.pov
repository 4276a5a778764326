// mistake in line 3: a kind of picture that is not built, in a texture that is used; declaring it alone is none
#declare Unused = texture { pigment { image_map { iff "a.iff" } } } texture { pigment { rgbt 1 } }
#declare Tiles = pigment { image_map { iff "a.iff" } scale 2 }
#declare Floor = object { plane { y, 0 } pigment { Tiles rotate 30*y } }
camera { location <0, 1, -4> }
light_source { -9, rgb 1 }
object { Floor }
sphere { y, 1 pigment { Tiles } }
