// Bumps of fractals of all exponents and of both magnets with an `accuracy` so fine that the last digit of each iteration shows.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -1> direction z right 4*x up 3*y }
light_source { <-400, 600, -800>, rgb 1 }
box { <-2, 0.5, 0>, <-1, 1.5, 1> pigment { rgb 1 } normal { mandel 8 exponent 3 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <-1.5, 1.0, 0> } }
box { <-1, 0.5, 0>, <0, 1.5, 1> pigment { rgb 1 } normal { mandel 8 exponent 4 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <-0.5, 1.0, 0> } }
box { <0, 0.5, 0>, <1, 1.5, 1> pigment { rgb 1 } normal { mandel 8 exponent 5 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <0.5, 1.0, 0> } }
box { <1, 0.5, 0>, <2, 1.5, 1> pigment { rgb 1 } normal { mandel 8 exponent 9 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <1.5, 1.0, 0> } }
box { <-2, -0.5, 0>, <-1, 0.5, 1> pigment { rgb 1 } normal { julia <0.4, 0.5>, 8 exponent 3 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <-1.5, 0.0, 0> } }
box { <-1, -0.5, 0>, <0, 0.5, 1> pigment { rgb 1 } normal { julia <-0.5, 0.5>, 8 exponent 4 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <-0.5, 0.0, 0> } }
box { <0, -0.5, 0>, <1, 0.5, 1> pigment { rgb 1 } normal { julia <0.6, 0.5>, 8 exponent 6 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <0.5, 0.0, 0> } }
box { <1, -0.5, 0>, <2, 0.5, 1> pigment { rgb 1 } normal { julia <0.7, 0.4>, 8 exponent 12 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <1.5, 0.0, 0> } }
box { <-2, -1.5, 0>, <-1, -0.5, 1> pigment { rgb 1 } normal { magnet 1 mandel 8 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <-1.5, -1.0, 0> } }
box { <-1, -1.5, 0>, <0, -0.5, 1> pigment { rgb 1 } normal { magnet 2 mandel 8 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <-0.5, -1.0, 0> } }
box { <0, -1.5, 0>, <1, -0.5, 1> pigment { rgb 1 } normal { magnet 1 julia <0.6, 0.5>, 8 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <0.5, -1.0, 0> } }
box { <1, -1.5, 0>, <2, -0.5, 1> pigment { rgb 1 } normal { magnet 2 julia <0.7, 0.4>, 8 bump_size 0.3 interior 1, 1 exterior 5, 0.1 accuracy 0.0000000000001 scale 0.4 translate <1.5, -1.0, 0> } }
