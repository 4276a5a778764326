// A spherical camera whose mirrored right exchanges above and below.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { spherical location <0, 0.5, -2> right -1.33*x up <0.1, 1, 0> look_at <0, 0, 2> }
light_source { <1, 2, -1>, rgb 1 }
box { <-6, -3, -5>, <6, 4, 8> pigment { checker rgb <0.9, 0.8, 0.7> rgb <0.3, 0.4, 0.6> } finish { ambient 0.3 } hollow }
sphere { <-1.5, 0, 3>, 0.8 pigment { rgb <0.9, 0.3, 0.2> } }
box { <1, -1, 1>, <2, 0.5, 2> pigment { rgb <0.3, 0.8, 0.3> } }
cylinder { <-3, -3, -2>, <-3, 4, -2>, 0.4 pigment { rgb <0.9, 0.9, 0.2> } }
