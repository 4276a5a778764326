// A Julia fractal cut by a box, and cut from another.
// compare: channel<=130 pixels<=1% because "shadows of the surface on itself depend on how it was found"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
difference {
  julia_fractal { <-0.083, 0.0, -0.83, -0.025> quaternion sqr max_iteration 6 precision 20 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } }
  box { <-0.2, -2, -2>, <2, 0.3, 2> pigment { rgb <0.2, 0.4, 1> } }
}
difference {
  box { <0.2, -0.9, -0.5>, <1.3, -0.4, 0.4> pigment { rgb <0.2, 0.4, 1> } }
  julia_fractal { <-0.1, 0.4, -0.2, 0.3> hypercomplex max_iteration 5 precision 40 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } scale 0.6 translate <0.7, -0.4, 0> }
}
