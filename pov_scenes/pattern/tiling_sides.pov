// Faces of boxes on the sides of tiles: they belong to the tile at larger x and z, or to the one of the higher kind;
// 3, 12 to 14 and 19 have lines of their own.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <-20, 12, -20> look_at <8.6, 0, 0> right 26*x up 19.5*y }
light_source { <-30, 40, -50> rgb 1 parallel point_at 0 }
#default { finish { ambient 0.4 diffuse 0.6 } }
#declare Numbers = array[17] { 1, 5, 6, 8, 9, 11, 15, 16, 17, 18, 20, 21, 3, 12, 13, 14, 19 };
#for (I, 0, 16)
  box {
    0, <2, 2, 2>
    pigment { tiling Numbers[I] color_map { [0 rgb 1] [0.45 rgb <1, 0.6, 0.2>] [0.7 rgb <0.2, 0.5, 0.3>] [1 rgb <0.1, 0.1, 0.4>] } }
    translate <4*mod(I, 6), -4*int(I/6), 0>
  }
#end
