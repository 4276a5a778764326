// Dithering of one colour.
// switches: +FN +THB2
// switches: +FN +THD1
// switches: +FN +THFS
// size: 80x60
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <0, 0.3, 1>] [1 rgb <0, 0.3, 1>] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 ambient 0 }
}
