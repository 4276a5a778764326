// Heights from the high bytes of a TIFF file of 16 bits, a TIFF palette, and a PGM file with 100 as its largest number.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.05, 2, -3> look_at <0, 0.1, 0> angle 45 }
light_source { <-3, 5, -4>, rgb 1 }
#default { pigment { rgb <0.8, 0.7, 0.5> } }
height_field { tiff "heights/deep_grey.tif" scale <0.8, 0.5, 0.8> translate <-1.3, 0, -0.4> }
height_field { tiff "../texture/images/palette.tif" scale <0.8, 6, 0.8> translate <-0.4, 0, -0.4> }
height_field { pgm "heights/most_100.pgm" scale <0.8, 0.5, 0.8> translate <0.5, 0, -0.4> }
