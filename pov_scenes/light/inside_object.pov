// A lamp inside an opaque ball lights nothing outside it; inside a clear one it does.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-1.2, 0, 0>, rgb <1, 0.4, 0.4> }
light_source { <1.2, 0, 0>, rgb <0.4, 0.6, 1> }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.2, 0, 0>, 0.5 pigment { rgb <0.9, 0.8, 0.7> } finish { ambient 0.2 } }
sphere { <1.2, 0, 0>, 0.5 pigment { rgbf <1, 1, 1, 0.8> } }
