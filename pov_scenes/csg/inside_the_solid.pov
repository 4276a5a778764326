// The camera stands inside a difference and sees its inner walls.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.6, 0, -0.7> look_at <-0.3, 0, 1> angle 80 }
light_source { <0.6, 0.5, -0.4>, rgb 1 }
difference {
  box { -1, 1 pigment { checker rgb 0.9, rgb <0.5, 0.6, 0.8> scale 0.5 } }
  cylinder { <-0.3, -2, 0.3>, <-0.3, 2, 0.3>, 0.4 pigment { rgb <0.8, 0.4, 0.3> } }
}
