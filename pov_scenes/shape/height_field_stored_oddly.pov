// Heights from the indices of a TGA palette, from colours of a TIFF file multiplied by alpha, and from an HDR file.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.03, 2, -3> look_at <0, 0.1, 0> angle 45 }
light_source { <-3, 5, -4>, rgb 1 }
#default { pigment { rgb <0.8, 0.7, 0.5> } }
height_field { tga "heights/palette.tga" scale <0.8, 1.5, 0.8> translate <-1.3, 0, -0.4> }
height_field { tiff "heights/alpha.tif" scale <0.8, 0.5, 0.8> translate <-0.4, 0, -0.4> }
height_field { hdr "heights/runs.hdr" scale <0.8, 0.3, 0.8> translate <0.5, 0, -0.4> }
