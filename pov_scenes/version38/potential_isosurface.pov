// The pattern potential of an isosurface, outside of its container too.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare I = isosurface { function { x*x + y*y*0.5 - x*y*0.3 } threshold 0.2 contained_by { sphere { 0, 0.5 } } }
sphere { 0, 1.5 pigment { potential { I rotate 30*z } color_map { [0 rgb 1] [0.5 rgb <1, 0.6, 0.1>] [1 rgb <0.6, 0, 0.2>] } } finish { phong 0.5 } }
