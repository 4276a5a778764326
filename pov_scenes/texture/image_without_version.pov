// Without any `#version` files are read as before 3.7: nothing is decoded unless a gamma is written or stands in the file.
camera { orthographic location <2, 1, -5> right 4*x up 3*y look_at <2, 1, 0> }
#macro Tile(Picture, X, Y)
  box { <0, 0, 0>, <1, 1, 1> pigment { Picture } finish { ambient 1 diffuse 0 } translate <X, Y, 0> }
#end
Tile(pigment { image_map { png "images/rgb.png" } }, 0, 0)
Tile(pigment { image_map { png "images/gamma18.png" } }, 1, 0)
Tile(pigment { image_map { gif "images/palette.gif" } }, 2, 0)
Tile(pigment { image_map { jpeg "images/full.jpg" } }, 3, 0)
Tile(pigment { image_map { tga "images/rgb.tga" } }, 0, 1)
Tile(pigment { image_map { ppm "images/rgb.ppm" } }, 1, 1)
Tile(pigment { image_map { png "images/rgb.png" gamma 2.2 } }, 2, 1)
Tile(pigment { image_pattern { png "images/rgb.png" gamma srgb } color_map { [0 rgb 0] [1 rgb 1] } }, 3, 1)
