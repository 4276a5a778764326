// A Julia fractal of the function sin.
// compare: channel<=255 pixels<=0.1% because "single points of the rough surface differ, its shadows on itself probably"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
julia_fractal {
  <-0.1, 0.4, -0.2, 0.3>
  hypercomplex sin max_iteration 6 precision 30
  pigment { rgb <0.9, 0.7, 0.4> } finish { ambient 1 diffuse 0 }
 scale 0.5 }
