// Numbers of `interpolate` that mean nothing: the pattern is 0, and the first texture covers all.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <1.5, 1, -5> look_at <1.5, 1, 0> up 2 * y right 3 * x }
light_source { <3, 4, -5> rgb 1 }
plane {
  z, 0
  pigment { image_pattern { png "images/rgb.png" interpolate 1 } color_map { [0 rgb <1, 0.5, 0>] [1 rgb 1] } }
  finish { ambient 1 diffuse 0 }
}
box {
  <1.5, 0, -0.1>, <3, 2, 0>
  texture {
    material_map {
      png "images/palette.png" interpolate 1.5
      texture { pigment { rgb <0, 0.6, 0> } }
      texture { pigment { rgb <0, 0, 0.7> } }
    }
  }
}
