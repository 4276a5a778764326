// polynomial: terms in any order, with or without commas; the last of equal terms counts.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }

polynomial {
  2, xyz(0, 0, 0): -1, xyz(2, 0, 0): 5, xyz(2, 0, 0): 3 xyz(0, 2, 0): 1 xyz(0 0 2): 1, xyz(1, 1, 0): 1
  pigment { rgb <1, 0.7, 0.3> }
  translate x
}
polynomial {
  4 xyz(4, 0, 0): 1 xyz(0, 4, 0): 1 xyz(0, 0, 4.9): 1 xyz(2, 0, 0): -0.5 xyz(0, 0, 0): -0.3
  sturm
  pigment { rgb <0.4, 0.6, 1> }
  rotate <20, 30, 0>
  translate -x
}
