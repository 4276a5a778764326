// A slanted slice of a Julia fractal that is scaled unevenly.
// compare: channel<=130 pixels<=0.05% because "single shadows of the surface on itself depend on the last digits"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
julia_fractal {
  <-0.162, 0.163, 0.56, -0.599>
  quaternion sqr max_iteration 6 precision 40
  slice <0.2, 0.3, -0.1, 0.9>, 0.1
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
  scale <1.3, 0.8, 1> rotate 40*y
}
