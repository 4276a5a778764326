// Dithering with a working space of gamma 2.2.
// switches: +FN4 +THB3
// switches: +FN4 +THS2
// switches: +FN4 +THBN
// size: 80x60
#version 3.8;
global_settings { assumed_gamma 2.2 }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <1, 0.3, 0>] [1 rgb <0, 0.5, 1>] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 }
}
