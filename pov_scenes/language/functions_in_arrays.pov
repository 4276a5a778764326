// A function or spline in an array is a value: it may be given to a name or an item, and stand in the list of an array.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Sum = function(a, b) { a + b };
#declare From = array[2];
#declare From[0] = Sum;
#declare From[1] = function(a, b) { a - b };
#declare Into = array[2][2];
#declare Into[0][0] = From[1];
#declare One = From[0];
#declare Both = array[2] { From[0], Sum }
#declare Paths = array[1] { spline { 0, -1.5*x 1, 1.5*x } }
#declare Path = Paths[0];
#for (I, 0, 1, 0.25)
  sphere { Path(I), Into[0][0](1, 0.6) pigment { rgb <One(I, 0), Both[mod(4*I, 2)](0.2, I/2), 0.8> } }
#end
