// Before version 3.7 and without `assumed_gamma`, a gamma that is written decodes the file all the same.
#version 3.6;
camera { orthographic location <2, 1, -5> right 4*x up 3*y look_at <2, 1, 0> }
#macro Tile(Picture, X, Y)
  box { <0, 0, 0>, <1, 1, 1> pigment { Picture } finish { ambient 1 diffuse 0 } translate <X, Y, 0> }
#end
Tile(pigment { image_map { png "images/rgb.png" } }, 0, 0)
Tile(pigment { image_map { png "images/gamma18.png" } }, 1, 0)
Tile(pigment { image_map { png "images/rgb.png" gamma 2.2 } }, 2, 0)
Tile(pigment { image_map { png "images/gamma18.png" gamma 1.4 } }, 3, 0)
Tile(pigment { image_map { ppm "images/rgb.ppm" gamma srgb } }, 0, 1)
Tile(pigment { image_map { tiff "images/rgb.tif" gamma 1 } }, 1, 1)
Tile(pigment { image_pattern { png "images/rgb.png" gamma 2.2 } color_map { [0 rgb 0] [1 rgb 1] } }, 2, 1)
Tile(pigment { image_map { png "images/grey.png" gamma 2.2 } }, 3, 1)
