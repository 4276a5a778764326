// `fade_distance` without a `fade_power` halves what is seen through glass, but not the light in its shadow.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -8> look_at <0, 0.4, 0> angle 42 }
light_source { <-4, 9, -3>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9, rgb 0.5 } }
#macro Glass(At, Power)
  sphere { At, 0.8 pigment { rgbt <1, 1, 1, 0.9> } finish { ambient 0 diffuse 0 } interior { fade_distance 1 fade_power Power } }
#end
Glass(<-2, 1, 0>, 0)
Glass(<0, 1, 0>, 0.01)
Glass(<2, 1, 0>, -1)
