// TIFF files of 16 bits, with a palette, and with alpha for a pattern, a bump map and a material map. Above, transparency
// that is added to premultiplied colours.
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.2, 0.3, 0.4> }
camera { orthographic location <2, 1, -10> right 4*x up 3*y direction z }
light_source { <-10, 20, -30>, 1 }
#default { finish { ambient 1 diffuse 0 } }
#macro Tile(At) scale 0.95 translate At #end
box { 0, 1 pigment { image_map { tiff "images/deep.tif" } } Tile(0) }
box { 0, 1 pigment { image_map { tiff "images/palette.tif" interpolate 2 transmit 3, 0.6 } } Tile(x) }
box { 0, 1 pigment { image_pattern { tiff "images/alpha.tif" } color_map { [0 rgb 0] [0.5 rgb x] [1 rgb 1] } } Tile(2*x) }
box {
  0, 1 pigment { rgb 1 } normal { bump_map { tiff "images/alpha.tif" interpolate 2 bump_size 4 } }
  finish { ambient 0.1 diffuse 0.8 } Tile(3*x)
}
box {
  0, 1 texture {
    material_map { tiff "images/palette.tif" texture { pigment { rgb x } } texture { pigment { rgb y } } texture { pigment { rgb z } } }
  }
  Tile(y)
}
box {
  0, 1 texture {
    material_map { tiff "images/deep.tif" texture { pigment { rgb x } } texture { pigment { rgb y } } texture { pigment { rgb z } } }
  }
  Tile(x + y)
}
box { 0, 1 pigment { image_pattern { tiff "images/deep.tif" interpolate 2 } color_map { [0 rgb 0] [0.5 rgb x] [1 rgb 1] } } Tile(2*x + y) }
box { 0, 1 pigment { image_map { tiff "images/palette.tif" gamma 1.8 } } Tile(3*x + y) }
box { 0, 1 pigment { image_map { tiff "images/rgb.tif" transmit all 0.4 } } Tile(2*y) }
box { 0, 1 pigment { image_map { png "images/alpha.png" premultiplied on interpolate 2 transmit all 0.2 filter all 0.1 } } Tile(x + 2*y) }
box { 0, 1 pigment { image_map { tiff "images/fourth_sample.tif" } } Tile(2*x + 2*y) }
box { 0, 1 pigment { image_pattern { tiff "images/fourth_sample.tif" use_alpha } color_map { [0 rgb 0] [0.5 rgb x] [1 rgb 1] } } Tile(3*x + 2*y) }
