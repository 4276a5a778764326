// A tall picture keeps right at 1.33 and squeezes the ball.
#version 3.7;
global_settings { assumed_gamma 1 }
// size: 80x140
camera { location <0, 1, -5> look_at 0 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb <0.9, 0.8, 0.3> } }
