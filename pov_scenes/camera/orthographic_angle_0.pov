// An angle of 0 leaves the direction of an orthographic camera as it is and still counts as an angle: the picture is as wide as
// look_at is far away, in spite of right and up.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -3*z right 4/3*x up y direction 2*z angle 0 look_at 0 }
box { <-0.9, -0.7, 1>, <0.8, 0.6, 1.1> pigment { checker rgb 1 rgb <0.2, 0.5, 0.9> scale 0.2 } finish { ambient 1 diffuse 0 } }
sphere { 0, 0.4 pigment { rgb x } finish { ambient 1 diffuse 0 } }
