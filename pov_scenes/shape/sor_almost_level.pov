// Surfaces of revolution seen almost level, where the hits depend on the last digits of a cubic: a jug, a glass with light
// through it, a turned and stretched vase without caps, one with `sturm`.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 }
camera { location <0, 0.9, -6> look_at <0, 0.8, 0> right x * image_width / image_height angle 40 }
light_source { <6, 8, -7>, rgb 0.9 }
light_source { <-7, 4, -6>, rgb 0.4 }
background { rgb <0.3, 0.4, 0.6> }
plane { y, -0.2 pigment { checker rgb 0.9 rgb <0.2, 0.4, 0.3> scale 0.4 } }
sor {
  6, <0.2, -0.3>, <0.45, 0>, <0.6, 0.6>, <0.25, 1.1>, <0.35, 1.4>, <0.5, 1.6>
  pigment { rgb <0.8, 0.5, 0.3> }
  finish { phong 0.8 reflection 0.15 }
  translate -1.5 * x
  no_shadow
}
sor {
  8, <0, -0.1>, <0.4, 0>, <0.3, 0.06>, <0.06, 0.15>, <0.06, 0.7>, <0.4, 1>, <0.42, 1.5>, <0.38, 1.8>
  open
  pigment { rgbf <0.9, 1, 0.95, 0.85> }
  finish { specular 0.5 reflection 0.1 }
  interior { ior 1.4 }
}
sor {
  6, <0.3, -1>, <0.4, -0.8>, <0.15, -0.1>, <0.2, 0.3>, <0.45, 0.8>, <0.5, 1>
  open
  pigment { rgb <0.3, 0.6, 0.8> }
  rotate <4, 0, 7>
  scale <1, 0.9, 1.2>
  translate <1.4, 0.8, 0.2>
  no_shadow
}
sor {
  5, <0.1, -0.5>, <0.3, 0>, <0.15, 0.5>, <0.3, 0.9>, <0.4, 1.2>
  sturm
  pigment { rgb <0.9, 0.8, 0.2> }
  translate <0.7, 0, 1.5>
}
