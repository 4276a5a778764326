// Bumps of JPEG files, in colours and grey.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0.3, -4> look_at 0 angle 50 }
light_source { <5, 8, -10>, 1 }
sphere { <-0.8, 0, 0>, 0.9 pigment { rgb <0.9, 0.7, 0.5> } normal { bump_map { jpeg "../texture/images/quarter.jpg" map_type 1 interpolate 2 bump_size 3 } } }
sphere { <0.8, 0, 0>, 0.9 pigment { rgb <0.5, 0.7, 0.9> } normal { bump_map { jpeg "../texture/images/grey.jpg" map_type 1 bump_size 3 } } }
