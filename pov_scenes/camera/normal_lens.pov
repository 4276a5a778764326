// Camera: bumps bend the rays of a lens behind it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at <0, 0.5, 0> aperture 0.3 blur_samples 7 focal_point 0 normal { bumps 0.3 scale 0.25 } }
light_source { <3, 5, -9>, rgb 1 }
plane { y, 0 pigment { checker rgb 1 rgb 0.5 } }
sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb <0, 0, 1>] } scale 0.5 } }
sphere { y, 1 pigment { checker rgb <0, 1, 0> rgb 1 scale 0.3 } }
