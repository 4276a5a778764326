// area_illumination with jitter: each lamp gives its light from a place of its own, row by row, and none draws one where all is shadow.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -5> look_at 0 angle 60 }
light_source { <-2, 3, -2> 1 area_light <2, 0, 0>, <0, 0, 2>, 3, 4 jitter area_illumination }
light_source { <3, 2, -2> rgb <0.2, 0.2, 0.4> area_light x, y, 2, 2 jitter area_illumination circular orient adaptive 1 }
plane { y, -1 pigment { rgb 0.8 } }
sphere { 0, 0.7 pigment { rgb <1, 0.4, 0.2> } finish { phong 1 } }
