// A scene without `#version` is read as 3.7, but drawn without gamma.
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, version/4 pigment { rgb <0.8, 0.6, 0.3> } }
