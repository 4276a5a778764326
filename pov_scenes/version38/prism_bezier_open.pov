// An open prism of bezier splines, half transparent, with an interior_texture.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
prism { bezier_spline 0, 1, 8, <-1, 0>, <-1, 1>, <0.8, 1.4>, <1, 0>, <1, 0>, <1, -1.2>, <-1, -1>, <-1, 0> open
  texture { pigment { rgbt <1, 0.7, 0.3, 0.4> } } interior_texture { pigment { rgb <0.2, 0.3, 1> } } }
