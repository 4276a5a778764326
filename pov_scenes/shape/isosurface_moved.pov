// An isosurface scaled unevenly, with a mirror image.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
plane { y, -1 pigment { rgb 0.3 } finish { reflection 0.6 } }
isosurface {
  function { pow(x, 4) + pow(y, 4) + pow(z, 4) - 0.5 }
  contained_by { box { -1, <1, 1, 0.5> } }
  max_gradient 5
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
  scale <1.2, 0.7, 1> rotate <20, 30, 0>
}
