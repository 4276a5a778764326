// Indirect light of finishes with different brilliance, which share no samples.
#version 3.8;
global_settings { assumed_gamma 1 radiosity { brilliance on count 400 nearest_count 4 recursion_limit 1 pretrace_start 0.08 pretrace_end 0.02 } }
camera { orthographic location 5*y look_at 0 right 4*x up 3*y }
sky_sphere { pigment { gradient y color_map { [0 rgb <1, 0.4, 0.1>] [1 rgb <0.5, 0.8, 1.2>] } } }
#macro Strip(X, Brilliance) box { <X, 0, -2>, <X + 1, 0.1, 2> pigment { rgb 0.8 } finish { diffuse 0.8 brilliance Brilliance } } #end
Strip(-2, 0.5) Strip(-1, 1) Strip(0, 3) Strip(1, 10)
