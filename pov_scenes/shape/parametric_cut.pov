// The container cuts a parametric surface, whose inside is seen.
// size: 96x72
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
parametric {
  function { u*v } function { u*u - v*v } function { u + 0.3*v }
  <-1, -1> <1, 1>
  contained_by { box { <-0.8, -0.7, -1>, <0.8, 0.7, 1> } }
  max_gradient 2.5
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
  interior_texture { pigment { rgb <0.2, 0.4, 1> } }
  scale 1.2 rotate 40*y
}
