// Shadowless area light with `area_illumination` that is projected through a sphere.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,1,-5> look_at 0 }
light_source {
  <1,5,2>, rgb <1,0.8,0.6> area_light <1,1,0>, 2*y, 2, 3 area_illumination shadowless
  projected_through { sphere { <0.5,2.5,0>, 0.8 } }
}
sphere { 0, 1 pigment { rgb 1 } }
plane { y, -1 pigment { rgb 1 } }
