// Crystals of prisms with common caps, merged: the points on an upper cap are outside, so that a face stays between them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 6, -9> look_at <0, 0.8, 0> angle 40 }
light_source { <-20, 30, -30> rgb 1 shadowless }
#macro Crystal(High)
  merge {
    prism { linear_sweep linear_spline 0, 1, 7, <1, 0>, <0.5, 0.87>, <-0.5, 0.87>, <-1, 0>, <-0.5, -0.87>, <0.5, -0.87>, <1, 0> }
    prism { conic_sweep linear_spline 0, 1, 7, <1, 0>, <0.5, 0.87>, <-0.5, 0.87>, <-1, 0>, <-0.5, -0.87>, <0.5, -0.87>, <1, 0>
      scale <1, -High, 1> translate (1 + High)*y }
    pigment { rgbt <0.3, 0.5, 1, 0.5> }
    finish { ambient 0.4 diffuse 0.6 }
  }
#end
object { Crystal(1) translate -1.3*x }
object { Crystal(2) rotate 20*y translate 1.3*x }
