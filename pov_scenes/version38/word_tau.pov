// `tau` is twice `pi`, in expressions and in functions.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, tau / 6 pigment { function { 0.5 + 0.5 * sin(tau * x * 2) } color_map { [0 rgb x] [1 rgb y] } } }
