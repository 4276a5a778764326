// With `once` the far edges themselves still belong to the picture, and show its first column and its lowest row.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <4, 3, -5> right 8*x up 6*y look_at <4, 3, 0> }
#declare Plain = function { pigment { image_map { png "images/rgb.png" once } } }
#declare Mixed = function { pigment { image_map { png "images/rgb.png" once interpolate 2 } } }
#declare Round = function { pigment { image_map { png "images/rgb.png" once map_type 2 } } }
#macro Probe(F, I, X, Y)
  #local C = F(X, Y, 0.3);
  box { <0, 0, 0>, <1, 1, 1> pigment { rgb <C.red, C.green, C.blue> * (1 - C.transmit/2) } finish { ambient 1 diffuse 0 } translate <mod(I, 8), int(I/8), 0> }
#end
#declare Places = array[8] { -0.001, 0, 0.3, 0.999, 1 - 1e-12, 1, 1 + 1e-12, 1.3 }
#declare I = 0;
#while (I < 8)
  Probe(Plain, I, Places[I], 0.4)
  Probe(Plain, I + 8, 0.4, Places[I])
  Probe(Mixed, I + 16, Places[I], Places[7 - I])
  Probe(Mixed, I + 24, Places[I], Places[I])
  Probe(Round, I + 32, 0.4, Places[I])
  Probe(Plain, I + 40, Places[I], 1)
  #declare I = I + 1;
#end
