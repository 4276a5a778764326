// Hexagons on all four sides of the origin.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0.1, 5, 0.2> look_at <0.1, 0, 0.2> right 16*x up 12*y }
plane { y, 0 pigment { hexagon rgb 1, rgb <0.8, 0.6, 0>, rgb <0, 0.3, 0.6> } finish { ambient 1 } }
