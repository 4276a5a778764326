// A sea whose surface is a face of its container, as authors write it, from below: the face is not seen where the function
// is zero on it, which the last digits of each ray decide.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, -2, 0> look_at <0, .4, 1> angle 90 }
light_source { <5, 9, -9> 1 }
background { rgb .3 }
isosurface {
  function { y } accuracy .0001 max_gradient 5 contained_by { box { -100, <1000, 0, 1000> } }
  pigment { rgb <0, .4, .6> } finish { emission .8 } hollow
}
sphere { <0, 1.5, 5>, 1 pigment { rgb <.9, .3, .1> } }
