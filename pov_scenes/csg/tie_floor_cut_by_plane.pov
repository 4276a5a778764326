// A floor cut from a box by a plane, under a glass box: the plane cuts the bounding box too, which decides the tie.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 10 }
camera { location <3.5, 2.9, -5> look_at <0, 0.4, 0> angle 38 }
light_source { <-7, 9, -3>, rgb 1 }
background { rgb <0.2, 0.3, 0.5> }
difference {
  box { -30, 30 }
  plane { -y, 0 }
  pigment { checker rgb 1 rgb 0.6 scale 0.37 }
}
box {
  <-1, 0, -1>, <1, 1, 1>
  pigment { rgbf <0.8, 0.9, 1, 0.9> }
  finish { reflection 0.1 }
  interior { ior 1.5 }
}
