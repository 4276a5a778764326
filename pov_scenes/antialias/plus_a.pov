// `+A` alone: method 1, threshold 0.3, depth 3, jitter.
// switches: +A
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
background { rgb <0.5, 0.7, 0.9> }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
torus { 0.8, 0.25 rotate -50*x translate <-0.9, 0, 0> pigment { rgb <0.9, 0.5, 0.2> } finish { phong 0.7 } }
difference {
  box { -0.7, 0.7 }
  sphere { 0, 0.9 }
  rotate <20, 40, 0> translate 1.2*x
  pigment { rgb <0.3, 0.7, 0.4> } finish { reflection 0.3 }
}
