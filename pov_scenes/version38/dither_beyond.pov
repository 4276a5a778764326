// Dithering of values below 0 and above 1.
// switches: +FN1 +THB2
// switches: +FN1 +THBN
// switches: +FN1 +THD1
// switches: +FN1 +THFS
// switches: +FN1 +THAT
// switches: +FN1 +THJN
// size: 80x60
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <-0.4, 0.3, 0.9>] [1 rgb <0.2, 1.5, 1.02>] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 }
}
