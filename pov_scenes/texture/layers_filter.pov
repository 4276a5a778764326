// A filtering layer on top tints the layers below it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1.1
  texture { pigment { checker rgb 0.9, rgb <0.2, 0.4, 0.9> scale 0.5 } finish { ambient 0.3 } }
  texture { pigment { rgbf <0.9, 0.5, 0.4, 0.7> } finish { specular 0.6 } }
  texture { pigment { checker rgbf <1, 1, 1, 0.9>, rgbt <0, 0, 0, 0.6> scale 0.25 rotate 45*z } }
}
