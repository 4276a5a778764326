// Radiosity whose samples lie where the rays of the pretrace of 3.8 meet the floor, the sphere and the box.
#version 3.8;
global_settings { assumed_gamma 1 radiosity { count 50 nearest_count 5 error_bound 0.8 recursion_limit 1 pretrace_start 0.08 pretrace_end 0.02 } }
camera { location <0, 1, -4> look_at <0, 0.5, 0> angle 50 }
plane { y, 0 pigment { rgb 0.8 } }
sphere { <-0.5, 0.6, 0>, 0.6 pigment { rgb <0.9, 0.2, 0.1> } }
box { <0.4, 0, -0.4>, <1.1, 0.9, 0.3> pigment { rgb <0.2, 0.4, 0.9> } }
sky_sphere { pigment { gradient y color_map { [0 rgb 0.3] [1 rgb <0.6, 0.8, 1>] } } }
