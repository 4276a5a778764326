// Media: transforms before the interior leave the density, those behind move it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
plane { y, -1.07 hollow pigment { checker rgb 0.8 rgb 0.5 } }
sphere { 0, 1 hollow pigment { rgbt 1 } scale <1, 0.5, 1> rotate 30*z
  interior { media { emission 1 density { spherical } } }
  translate 0.3*x
}
