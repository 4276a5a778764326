// Where the surface of an isosurface meets a wall of its box, roots on the wall have the normal of the surface; a ray that is
// in the box for less than `accuracy` hits nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2.2, 2.4, -3.2> look_at <0, -.1, 0> angle 40 }
light_source { <5, 9, -4> rgb 1 }
background { rgb <.9, .2, .1> }
isosurface {
  function { y + .3 * sin(5 * x) * cos(4 * z) - .3 } accuracy .02 max_gradient 2
  contained_by { box { -1, <1, .5, 1> } }
  pigment { rgb 1 } finish { phong .5 }
}
