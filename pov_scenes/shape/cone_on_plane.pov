// A clear cone that stands on a plane: roundings decide what shows through it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 2.1, -3.4> look_at 0.3*y angle 42 }
light_source { <20, 40, -30>, 1 }
background { rgb <0.4, 0.5, 0.7> }
plane { y, 0 pigment { checker rgb <1, 1, 0.6>, rgb <0.3, 0.3, 0.6> scale 0.31 } }
cone { 0, 1, y, 0.6 pigment { rgbf <0.8, 1, 0.9, 0.8> } }
