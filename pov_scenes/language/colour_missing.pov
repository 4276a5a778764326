// A colour without a value is black; a second one missing in reflection is the first.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
background { }
#declare Nothing = color;

plane { y, -1 pigment { checker rgb 1 color } }
sphere { <-1, 0, 0>, 0.9 pigment { rgb 0.5 } finish { ambient diffuse 0.5 reflection { 0.3, } } }
sphere { <1, 0, 0>, 0.9 pigment { rgb <1, 0.7, 0.3> + Nothing } finish { ambient 0.3 reflection { } } }
sphere { <0, 1.4, 0>, 0.5 pigment { color } finish { ambient rgb 1 phong 1 } }
