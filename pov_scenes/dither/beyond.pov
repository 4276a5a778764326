// Dithering of values below 0 and above 1.
// switches: +FN5 +THB2
// switches: +FN5 +THD1
// switches: +FN5 +THD2
// switches: +FN5 +THFS
// size: 80x60
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <-0.4, 0.3, 0.9>] [1 rgb <0.2, 1.5, 1.02>] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 ambient 0 }
}
