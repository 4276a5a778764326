// The mirror image of a lower layer is left out where the layers above let so little through that its share is below the bailout.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -5> look_at 0 angle 50 }
light_source { <3, 8, -4> rgb 1 }
background { rgb 1 }
plane { z, 0
  texture { pigment { rgb <0.8, 0.5, 0.3> } finish { reflection 0.35 } }
  texture { pigment { gradient x color_map { [0 rgbf 1] [0.95 rgbf <1, 1, 1, 0.03>] [1 rgb 1] } scale 4 translate -2 * x } }
}
