// Lamps are moved at random, by numbers that go on from pixel to pixel and are not spent on what takes no light.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -8> look_at <0, 0.6, 0> angle 45 }
light_source { <-4, 8, -3>, rgb 1 area_light 2*x, 2*z, 5, 5 adaptive 1 jitter }
light_source { <5, 6, -4>, rgb <0.4, 0.4, 0.6> area_light x, y, 3, 3 jitter circular orient }
plane { y, 0 pigment { rgb <0.9, 0.8, 0.7> } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.8, 0.3, 0.2> } finish { phong 0.6 } }
box { <0.5, 0, -1>, <1.6, 1.4, 0.2> pigment { rgb 1 } finish { ambient 0.4 diffuse 0 } }
