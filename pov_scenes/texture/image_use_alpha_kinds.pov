// `use_alpha` with kinds of files that have no alpha: the red of a BMP palette, and 0 of TIFF and HDR.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <2, 1, -10> right 4*x up 3*y direction z }
background { rgb <0.2, 0.3, 0.4> }
#macro Tile(At) color_map { [0 rgb z] [0.5 rgb x] [1 rgb 1] } } finish { ambient 1 diffuse 0 } scale 0.95 translate At } #end
box { 0, 1 pigment { image_pattern { bmp "images/four_bits.bmp" use_alpha } Tile(0)
box { 0, 1 pigment { image_pattern { tiff "images/rgb.tif" use_alpha } Tile(x)
box { 0, 1 pigment { image_pattern { hdr "images/runs.hdr" use_alpha } Tile(2*x)
box { 0, 1 pigment { image_pattern { tiff "images/palette.tif" use_alpha } Tile(3*x)
box { 0, 1 pigment { image_pattern { bmp "images/alpha.bmp" use_alpha interpolate 2 } Tile(y)
box { 0, 1 pigment { image_pattern { tiff "images/alpha.tif" use_alpha } Tile(x + y)
box { 0, 1 pigment { image_pattern { tga "images/palette.tga" use_alpha } Tile(2*x + y)
box { 0, 1 pigment { image_pattern { bmp "images/runs8.bmp" use_alpha interpolate 2 } Tile(3*x + y)
