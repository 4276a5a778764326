// Beads of inverse planes, with and without a hole, merged with a sphere beside them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -8> look_at 0 }
light_source { <3, 5, -9>, 1 }
background { rgb <0.2, 0.25, 0.3> }
#declare Bead = intersection {
  plane { x, -0.5 inverse } plane { -x, -0.5 inverse }
  plane { y, -0.5 inverse } plane { -y, -0.5 inverse }
  plane { z, -0.5 inverse } plane { -z, -0.5 inverse }
}
merge {
  sphere { 0, 1 }
  object { Bead translate <2.5, 0.9, 0> }
  difference { object { Bead } cylinder { -z, z, 0.2 } translate <-2.5, 0.7, 0> }
  pigment { rgb <1, 0.6, 0.3> }
}
