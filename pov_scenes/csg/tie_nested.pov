// Of coincident solids in a union the last shows, and each combination around it reverses that: red, green, red.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.37, 4.3, -9.1> look_at <0, 0.8, 0> angle 45 }
light_source { <-6, 9, -8>, rgb 1 }
plane { y, 0 pigment { rgb 0.5 } }
#declare Pair = union {
  box { <-1, 0, -1>, <1, 2, 1> pigment { rgb <0.8, 0.1, 0.1> } }
  box { <-1, 0, -1>, <1, 1.4, 1> pigment { rgb <0.1, 0.7, 0.1> } }
}
#declare Cutter = box { <-0.4, -1, -2>, <0.4, 0.6, 2> pigment { rgb <0.2, 0.3, 0.9> } }
#declare Slot = box { <-3, 0.8, -0.3>, <3, 1.2, 0.3> pigment { rgb <0.2, 0.3, 0.9> } }
difference { object { Pair } object { Cutter } translate -2.6*x }
difference { difference { object { Pair } object { Cutter } } object { Slot } }
difference {
  difference { difference { object { Pair } object { Cutter } } object { Cutter translate 1.8*y } }
  object { Slot }
  translate 2.6*x
}
