// Parts moved relative to parts: a knob on a door in a wall, each in the space of the one that holds it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2.5, 2.2, -6> look_at <0, 1.2, 0> angle 40 }
light_source { <-3, 6, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare Knob = union {
  sphere { <0, 0, -0.12>, 0.08 }
  cylinder { 0, <0, 0, -0.12>, 0.03 }
  pigment { rgb <1, 0.85, 0.2> } finish { phong 0.8 }
}
#declare Door = union {
  box { <0, 0, 0>, <1, 2, 0.08> pigment { rgb <0.6, 0.35, 0.2> } }
  // In the space of the door, whose hinge is the y axis.
  object { Knob translate <0.88, 1, 0> }
  object { Knob scale <1, 1, -1> translate <0.88, 1, 0.08> }
}
#declare Wall = union {
  difference {
    box { <-2, 0, 0>, <2, 2.6, 0.1> }
    box { <-0.5, -1, -1>, <0.5, 2, 1> }
    pigment { rgb <0.85, 0.85, 0.8> }
  }
  object { Door rotate 55*y translate -0.5*x }
}
object { Wall rotate -15*y }
object { Wall scale <-0.5, 0.5, 0.5> rotate 60*y translate <-1.2, 0, -1.8> }
plane { y, 0 pigment { checker rgb 0.8, rgb 0.6 } }
