// An orthographic camera whose rays start partly inside a solid.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, 0> look_at z right 4*x up 3*y }
light_source { <-4, 6, -8>, rgb 1 }
sphere { <0.3, 0, 0.2>, 0.9 pigment { rgbf <0.9, 0.6, 0.5, 0.7> } interior { ior 1.2 } }
plane { z, 3 pigment { checker rgb 0.9, rgb <0.2, 0.4, 0.3> scale 0.4 } }
