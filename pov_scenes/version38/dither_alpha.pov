// Dithering of a transparent picture.
// switches: +FN4 +UA +THB4
// switches: +FN4 +UA +THBN
// switches: +FN4 +UA +THBNX
// switches: +FN4 +UA +THFS
// switches: +FN4 +UA +THS3
// size: 80x60
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <1, 0.3, 0> transmit 0.2] [1 rgb <0, 0.5, 1> transmit 0.9] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 }
}
