// A height field seen from below, from the side, and through itself.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.6, 1.3, -1.1> look_at <0.5, 0.35, 0.5> }
light_source { <-3, 5, -4> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
plane { -y, -3 pigment { rgb 1 } finish { ambient 0.5 } }
height_field { png "heights/deep.png" pigment { rgbt <0.5, 0.9, 0.4, 0.5> } translate -0.5 scale <1.5, 0.7, 1.5> rotate -100*x translate 0.5 }
