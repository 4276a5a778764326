// From three things on the bounding tree is used, and a sphere of negative radius is lost in it: only the left one shows.
// compare: channel<=133 pixels<=21.2% because "POV-Ray's bounding tree loses spheres of negative radius, whose surface is well defined"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.1, 0, 0>, 0.9 pigment { rgb <0.2, 0.6, 0.3> } }
sphere { <1.1, 0, 0>, -0.9 pigment { rgb <0.2, 0.6, 0.3> } }
