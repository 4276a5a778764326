// Dithering where the working space is that of the file.
// switches: +FN2 +THAT
// switches: +FN2 +THB2
// switches: +FN2 +THB3
// switches: +FN2 +THB4
// switches: +FN2 +THBK
// switches: +FN2 +THBN
// switches: +FN2 +THBNX
// switches: +FN2 +THD1
// switches: +FN2 +THD2
// switches: +FN2 +THFS
// switches: +FN2 +THJN
// switches: +FN2 +THS2
// switches: +FN2 +THS3
// switches: +FN2 +THST
// size: 80x60
#version 3.8;
global_settings { assumed_gamma srgb }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <1, 0.3, 0>] [1 rgb <0, 0.5, 1>] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 }
}
