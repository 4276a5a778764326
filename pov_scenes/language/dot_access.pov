// Components by letters and by colour words, of vectors of two to five.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare V2 = <0.3, 0.9>;
#declare V4 = <0.2, 0.5, 0.1, 0.6>;
#declare V5 = <0.9, 0.3, 0.2, 0.1, 0.4>;
#declare C = rgbft <0.2, 0.7, 0.9, 0.3, 0.1>;
sphere { <-1.8, V2.u - 0.3, 0>, V2.v/2 pigment { rgb <V2.x, V2.y, 0> } }
sphere { <-0.6, V4.z, 0>, V4.t pigment { rgb <V4.x, V4.y, V4.z> } }
sphere { <0.7, C.transmit, 0>, C.filter + 0.2 pigment { rgb <C.red, C.green, C.blue> } }
sphere { <1.8, V5.transmit - 0.4, 0>, 0.4 pigment { rgb V5.red*<1, 1, 0.5> filter V5.filter } }
sphere { <0, 1, 1.5>, 0.3 pigment { rgb C.gray } }
