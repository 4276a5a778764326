// Rays that a pane sends on ignore its back, nearer than 0.0001, and bodies that touch it: no ray more or less reaches
// the surfaces behind, so that the samples of irradiance are POV-Ray's.
#version 3.7;
global_settings {
  assumed_gamma 1
  radiosity { pretrace_start 0.08 pretrace_end 0.02 count 30 nearest_count 4 error_bound 0.8 recursion_limit 2 }
}
camera { location <0, 1.4, -6> look_at <0, 0.8, 0> angle 50 }
light_source { <4, 6, -5>, 0.7 }
background { rgb <0.3, 0.4, 0.6> }
plane { y, 0 pigment { rgb <0.8, 0.7, 0.6> } finish { ambient 0 } }
#for (I, 0, 4)
  sphere { <I - 2, 0.6, 0.4>, 0.4 pigment { rgb <0.9, 0.2 * I, 0.3> } finish { ambient 0 } }
#end
box { <-2.5, 0.1, -0.00005>, <2.5, 1.2, 0> pigment { rgbt <0.8, 0.9, 0.8, 0.8> } finish { ambient 0 } }
#for (I, 0, 3)
  cylinder { <I - 1.5, 0.2, 0.00008>, <I - 1.5, 1.1, 0.1>, 0.2 pigment { rgb <0.3, 0.9, 0.2 * I> } finish { ambient 0 } }
#end
