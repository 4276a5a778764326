// TGA: palettes, 5 bits per channel, columns from the right; TIFF with alpha; HDR; PGM with a maximum of 99; a clear colour.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <2, 1, -5> look_at <2, 1, 0> right 4.1*x up 3.075*y }
plane { z, 1 pigment { checker rgb 0.2, rgb 0.9 scale 0.13 } finish { ambient 1 diffuse 0 } }
#declare N = 0;
#macro Show(P)
  box { 0, <0.97, 0.98, 0.1> pigment { P } finish { ambient 1 diffuse 0 } translate <mod(N, 4) + 0.013, div(N, 4) + 0.011, 0> }
  #declare N = N + 1;
#end
Show(pigment { image_map { tga "images/palette.tga" filter 3 1 transmit 5 0.5 } })
Show(pigment { image_map { tga "images/five_bits.tga" } })
Show(pigment { image_map { tga "images/from_right.tga" interpolate 2 } })
Show(pigment { image_map { tiff "images/alpha.tif" gamma 1.5 } })
Show(pigment { image_map { tiff "images/alpha.tif" interpolate 2 } })
Show(pigment { image_map { hdr "images/runs.hdr" } })
Show(pigment { image_map { pgm "images/most_99.pgm" } })
Show(pigment { image_map { png "images/clear_colour.png" } })
