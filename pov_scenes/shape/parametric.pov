// A parametric surface.
// size: 96x72
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
parametric {
  function { sin(u)*cos(v) } function { cos(u) } function { sin(u)*sin(v)*(1 + 0.2*sin(4*v)) }
  <0, 0>, <pi, 2*pi>
  contained_by { sphere { 0, 1.3 } }
  max_gradient 1.8 accuracy 0.02 precompute 10, x, y, z
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
}
