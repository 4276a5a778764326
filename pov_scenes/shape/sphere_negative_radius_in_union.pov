// A union at the top level is taken apart, so a sphere of negative radius in it is lost as well.
// compare: channel<=136 pixels<=13.7% because "POV-Ray's bounding tree loses spheres of negative radius, whose surface is well defined"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union {
  box { <-1.6, -0.9, -0.5>, <-0.6, 0.8, 0.5> }
  box { <1.4, -0.9, -0.5>, <1.8, 0.8, 0.5> }
  sphere { <0.4, 0, 0>, -0.7 }
  pigment { rgb <0.7, 0.6, 0.3> }
}
