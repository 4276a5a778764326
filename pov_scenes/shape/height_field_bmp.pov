// Heights of BMP files with palettes: of one bit, of which POV-Ray takes all for the second colour, of four bits, and
// of runs that pass over some pixels.
// The light is shadowless, since POV-Ray loses shadows of cells near their edges.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.9, 1.5, -1.2> look_at <0.9, 0.25, 0.5> }
light_source { <-3, 5, -4> rgb 1 shadowless }
background { rgb <0.1, 0.2, 0.3> }
height_field { bmp "heights/one_bit.bmp" pigment { rgb <0.9, 0.7, 0.4> } scale <0.55, 20, 1> }
height_field { "heights/four_bits.bmp" smooth pigment { rgb <0.5, 0.7, 0.9> } scale <0.55, 5, 1> translate 0.6*x }
height_field { bmp "heights/runs" smooth pigment { rgb <0.5, 0.9, 0.6> } scale <0.55, 0.5, 1> translate 1.2*x }
