// The rays that gather indirect light draw the random numbers of `crand` from a sequence of their own, which runs on.
#version 3.7;
global_settings {
  assumed_gamma 1
  radiosity { count 20 nearest_count 3 error_bound 1 recursion_limit 3 pretrace_end 0.02 }
}
camera { location <0, 2, -6> look_at <0, 1, 0> }
light_source { <5, 9, -4>, rgb 1.2 }
#default { pigment { rgb <0.8, 0.7, 0.6> } finish { ambient 0 diffuse 0.7 } }
plane { y, 0 pigment { rgb 0.9 } finish { diffuse 0.8 crand 0.5 } }
plane { -z, -3 pigment { rgb <0.4, 0.6, 0.9> } finish { crand 0.2 } }
sphere { <-1, 1, 0>, 1 }
box { <0.5, 0, -1>, <2, 1.4, 0.6> }
