// The tiling 27 in colours for each of its kinds of tiles, flat and from above.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0.37, 10, 0.21> direction -y right 12*x up 9*z }
plane { y, 0
  pigment { tiling 27 color_map { [0 rgb <0.9, 0.2, 0.1>] [0.3 rgb <0.2, 0.3, 0.9>] [0.6 rgb <0.9, 0.8, 0.3>] [1 rgb <0.1, 0.5, 0.2>] } rotate 7*y }
  finish { ambient 1 diffuse 0 }
}
