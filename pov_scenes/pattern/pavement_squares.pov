// The pavement of five squares, flat and from above.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0.37, 10, 0.21> direction -y right 12*x up 9*z }
plane { y, 0
  pigment {
    pavement number_of_sides 4 number_of_tiles 5 pattern 8
    color_map { [0 rgb <0.9, 0.8, 0.6>] [0.7 rgb <0.3, 0.4, 0.7>] [1 rgb 0.1] } rotate 7*y
  }
  finish { ambient 1 diffuse 0 }
}
