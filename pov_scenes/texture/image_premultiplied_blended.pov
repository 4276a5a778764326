// Colours that are stored multiplied by alpha are blended as stored and divided by the blended alpha.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <1.5, 0.5, -5> look_at <1.5, 0.5, 0> right 3*x up 2.25*y }
plane { z, 1 pigment { checker rgb 0.2, rgb 0.9 scale 0.13 } finish { ambient 1 diffuse 0 } }
#declare N = 0;
#macro Show(P) box { 0, <0.97, 0.98, 0.1> pigment { P } finish { ambient 1 diffuse 0 } translate <N + 0.013, 0, 0> } #declare N = N + 1; #end
Show(pigment { image_map { png "images/alpha.png" premultiplied on interpolate 2 } })
Show(pigment { image_map { png "images/alpha.png" premultiplied on interpolate 3 } })
Show(pigment { image_map { tiff "images/alpha.tif" premultiplied off interpolate 4 } })
