// A material carries texture and interior together.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Amber = material {
  texture { pigment { rgbf <1, 0.7, 0.2, 0.8> } finish { specular 0.7 } }
  interior { ior 1.5 fade_distance 1 fade_power 1 }
};
sphere { <-1, 0, 0>, 0.8 material { Amber } }
box { <0.3, -0.9, -0.5>, <1.5, 0.6, 0.5> material { Amber } }
