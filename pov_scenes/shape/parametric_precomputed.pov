// Ranges of parametric surfaces put together by `precompute`: of a function with a pole, and with the gradient and accuracy that
// stand before the word.
// size: 80x60
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -6> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#default { pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } }
parametric {
  function { u } function { 0.3/u } function { v } <-1, -1>, <1, 1>
  contained_by { box { -1.2, 1.2 } } max_gradient 4 accuracy 0.04 precompute 8 x, y, z
  translate -1.5*x
}
parametric {
  function { sin(u)*cos(v) } function { cos(u) } function { sin(u)*sin(v)*(1 + 0.4*sin(6*v)) } <0, 0>, <pi, 2*pi>
  contained_by { box { -1.3, 1.3 } } precompute 8 y, z max_gradient 2 accuracy 0.04
  translate 1.3*x
}
