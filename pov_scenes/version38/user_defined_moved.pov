// The point of `user_defined` follows transforms, warps and turbulence.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { <-1.5, 0, 0>, 1.2 pigment { user_defined { function { abs(sin(3 * x)) }, function { abs(cos(3 * y)) } } scale 0.5 rotate 30*z } }
sphere { <1.5, 0, 0>, 1.2 pigment { user_defined { function { abs(sin(3 * x)) }, function { abs(cos(3 * y)) } } warp { repeat 0.7*x } turbulence 0.3 } }
