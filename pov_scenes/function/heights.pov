// A function called in a loop gives the heights of boxes, one that calls another the colours.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -7> look_at 0 angle 50 }
light_source { <-4, 6, -8>, rgb 1 }
#declare R = function(a, b) { sqrt(a*a + b*b) }
#declare H = function(a, b) { cos(3*R(a, b))/(1 + R(a, b)) }
#declare Level = function { H(x, y) - z*H(y, x) > 0.1 & x < y | z }
#for (X, -2, 2, 0.25)
  #for (Z, -2, 2, 0.25)
    box { <X, -1, Z>, <X + 0.2, H(X, Z), Z + 0.2> pigment { rgb <0.5 + H(X, Z)/2, Level(X, Z, 0), 0.3> } }
  #end
#end
