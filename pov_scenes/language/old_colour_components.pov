// Before 3.5 components may follow the name of a colour in a declaration and in an array; such a name after the radius
// of a disc is its colour.
#version 3.1
camera { location <0, 1, -5> look_at 0 }
light_source { <-3, 5, -6>, 1 }
#declare Orange = color rgb <1, 0.6, 0.3>
#declare Pale = Orange filter 0.6
#declare Both = array[2] { Orange filter 0.5, Orange green 0.9 transmit 0.3 }
sphere { -1.4*x, 0.9 pigment { Pale } }
sphere { 0.6*x, 0.8 pigment { color Both[0] } }
sphere { 2.2*x, 0.7 pigment { color Both[1] } }
disc { <0, 1.6, 0>, <0, 1, -1>, 0.5 pigment { Orange } }
plane { y, -1 pigment { checker rgb 1 rgb 0.3 } }
