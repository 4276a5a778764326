// Bevelled box, cylinder, ring and wedge by the macros of bevel.inc.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "../include/bevel.inc"
camera { location <0, 4, -7> look_at <0, 0, 0> angle 42 }
light_source { <-4, 7, -6> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare Looks = texture { pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.6 } }
object { Bevel_box(<-0.8, -0.5, -0.6>, <0.8, 0.5, 0.6>, 0.2) texture { Looks } rotate 30*y translate <-1.5, 0, -0.8> }
object { Bevel_cylinder(-0.5, 0.5, 0.8, 0.2) texture { Looks } translate <1.5, 0, -0.8> }
object { Bevel_ring(-0.3, 0.3, 0.5, 1, 0.15) texture { Looks } rotate -30*x translate <-1.5, 0, 1.5> }
object { Bevel_wedge(-0.4, 0.4, 0.6, 1.4, 200, 320, 0.15) texture { Looks } translate <1.6, 0, 2> }
plane { y, -0.8 pigment { rgb 0.7 } }
