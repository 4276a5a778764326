// Light bends at the tilted normal of the top layer.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
sphere { 0, 1
  texture { pigment { rgbf <1, 1, 1, 0.9> } normal { ripples 0.3 scale 0.2 } }
  texture { pigment { rgbt <1, 0.9, 0.8, 0.8> } normal { bumps 0.1 scale 0.3 } finish { specular 0.7 reflection { 0.05, 0.6 fresnel } conserve_energy } }
  interior { ior 1.4 }
}
plane { y, -1.07 pigment { wood color_map { [0 rgb 1] [1 rgb <0.2, 0.5, 0.9>] } sine_wave rotate 90*x scale 3 } }
