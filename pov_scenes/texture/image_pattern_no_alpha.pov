// `use_alpha` with pictures without alpha: the red of colours and greys, and 0 of a palette.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <2, 1, -10> right 4*x up 3*y direction z }
background { rgb <0.2, 0.3, 0.4> }
#macro Tile(At) color_map { [0 rgb 0] [0.5 rgb x] [1 rgb 1] } } finish { ambient 1 diffuse 0 } translate At } #end
box { 0, <0.95, 0.95, 1> pigment { image_pattern { png "images/rgb.png" use_alpha } Tile(0)
box { 0, <0.95, 0.95, 1> pigment { image_pattern { png "images/grey.png" use_alpha interpolate 2 } Tile(x)
box { 0, <0.95, 0.95, 1> pigment { image_pattern { png "images/palette.png" use_alpha } Tile(2*x)
box { 0, <0.95, 0.95, 1> pigment { image_pattern { gif "images/palette.gif" use_alpha interpolate 2 } Tile(y)
