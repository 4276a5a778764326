// Dithering of a transparent picture.
// switches: +FN +UA +THB4
// switches: +FN5 +UA +THFS
// switches: +FN5 +UA +THD2
// size: 80x60
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <1, 0.3, 0> transmit 0.2] [1 rgb <0, 0.5, 1> transmit 0.9] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 ambient 0 }
}
