// Terms of polynomials with negative powers stand for other terms.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <-3, 5, -6>, 1 }
polynomial { 4, xyz(4, 0, 0): 1, xyz(0, 4, 0): 1, xyz(0, 0, 4): 1, xyz(1, -1, 2): 0.4, xyz(0, 0, 0): -1 pigment { rgb <1, 0.5, 0.2> } translate -1.3*x }
polynomial { 2, xyz(2, 0, 0): 1, xyz(0, 2, 0): 1, xyz(0, 0, 2): 1, xyz(2, 0, -1): 0.3, xyz(0, 0, 0): -1 pigment { rgb <0.2, 0.5, 1> } translate 1.3*x }
