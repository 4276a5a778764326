// `version` is the number in force; directives may ask for it and change it.
#version 3.6;
#declare Old = version;
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1, 0, 0>, Old/6 pigment { rgb <0.8, 0.3, 0.3> } }
#if (version >= 3.7) sphere { <1, 0, 0>, version/6 pigment { rgb <0.3, 0.3, 0.8> } } #end
