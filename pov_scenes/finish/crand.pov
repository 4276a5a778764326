// Grain by numbers that go on from pixel to pixel: opaque, in layers, in mirrors, and in turn for each light.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
light_source { <-3, 8, -9>, rgb 0.5 }
plane { y, 0 pigment { granite color_map { [0 rgb 0.4][1 rgb 0.9] } } finish { crand 0.1 } }
sphere { <-1.6, 1, 0>, 1 pigment { rgb <0.8, 0.6, 0.4> } finish { crand 0.3 reflection 0.3 } }
box {
  <0.4, 0, -1>, <2, 1.6, 0.6>
  texture { pigment { rgb <0.4, 0.6, 0.8> } finish { crand 0.2 } }
  texture { pigment { checker rgbt 1, rgbt <0.8, 0.7, 0.6, 0.4> scale 0.4 } finish { crand 0.2 } }
}
