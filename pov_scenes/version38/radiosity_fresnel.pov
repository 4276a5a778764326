// The light of radiosity on finishes with `fresnel`, fully and by half, and with none.
#version 3.8;
global_settings { assumed_gamma 1 radiosity { count 50 nearest_count 4 error_bound 1 recursion_limit 1 pretrace_start 0.08 pretrace_end 0.02 } }
camera { location <0, 1, -4> look_at <0, 0.5, 0> angle 50 }
sky_sphere { pigment { gradient y color_map { [0 rgb <1, 0.8, 0.6>] [1 rgb <0.5, 0.7, 1>] } } }
plane { y, 0 pigment { rgb 0.7 } finish { diffuse 0.9 fresnel } interior { ior 1.5 } }
sphere { <-1.1, 0.6, 0>, 0.5 pigment { rgb <0.9, 0.3, 0.2> } finish { fresnel 0.5 } interior { ior 2.2 } }
sphere { <0, 0.6, 0>, 0.5 pigment { rgb <0.9, 0.3, 0.2> } }
sphere { <1.1, 0.6, 0>, 0.5 pigment { rgb <0.9, 0.3, 0.2> } finish { fresnel 1 } interior { ior 1.3 } normal { bumps 0.4 scale 0.1 } }
