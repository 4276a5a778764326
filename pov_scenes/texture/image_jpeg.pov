// JPEG files of all kinds, pixel by pixel: colours of full resolution, of half and of a quarter of it, restart markers,
// progressive files, grey; and one too narrow for a filter.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <2, 1.5, -5> right 4*x up 3*y look_at <2, 1.5, 0> }
#macro Tile(Name, X, Y)
  box { <0, 0, 0>, <1, 1, 1> pigment { image_map { jpeg Name } } finish { ambient 1 diffuse 0 } translate <X, Y, 0> }
#end
Tile("images/full.jpg", 0, 0)
Tile("images/half.jpg", 1, 0)
Tile("images/quarter.jpg", 2, 0)
Tile("images/tall.jpg", 3, 0)
Tile("images/fourth.jpg", 0, 1)
Tile("images/progressive.jpg", 1, 1)
Tile("images/narrow.jpg", 2, 1)
Tile("images/grey.jpg", 3, 1)
plane { -z, -2 pigment { image_map { jpeg "images/quarter" interpolate 2 } scale 2 } finish { ambient 1 diffuse 0 } }
