// Dithering of a gradient by each method.
// switches: +FN +THAT
// switches: +FN +THB2
// switches: +FN +THB3
// switches: +FN +THB4
// switches: +FN +THBK
// switches: +FN +THBN
// switches: +FN +THBNX
// switches: +FN +THD1
// switches: +FN +THD2
// switches: +FN +THFS
// switches: +FN +THJN
// switches: +FN +THS2
// switches: +FN +THS3
// switches: +FN +THST
// switches: +FN +TH
// switches: +FN3 +THAT
// switches: +FN3 +THB2
// switches: +FN3 +THB3
// switches: +FN3 +THB4
// switches: +FN3 +THBK
// switches: +FN3 +THBN
// switches: +FN3 +THBNX
// switches: +FN3 +THD1
// switches: +FN3 +THD2
// switches: +FN3 +THFS
// switches: +FN3 +THJN
// switches: +FN3 +THS2
// switches: +FN3 +THS3
// switches: +FN3 +THST
// size: 80x60
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <1, 0.3, 0>] [1 rgb <0, 0.5, 1>] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 }
}
