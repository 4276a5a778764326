// Dithering where the working space is that of the file.
// switches: +FN5 +THB2
// switches: +FN5 +THB3
// switches: +FN5 +THB4
// switches: +FN5 +THD1
// switches: +FN5 +THD2
// switches: +FN5 +THFS
// size: 80x60
#version 3.7;
global_settings { assumed_gamma srgb }
camera { orthographic location -5*z right 4*x up 3*y }
plane {
  z, 0
  pigment { gradient x color_map { [0 rgb <1, 0.3, 0>] [1 rgb <0, 0.5, 1>] } rotate 7*z scale 4.2 translate -2.1*x }
  finish { emission 1 diffuse 0 ambient 0 }
}
