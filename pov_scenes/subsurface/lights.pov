// Subsurface light from area lights, fading, looking away and without shadows, and with a body in a light group.
#version 3.7;
global_settings { assumed_gamma 2.2 mm_per_unit 25 subsurface { samples 8, 5 } }
camera { location <0, 2, -5> look_at <0, .5, 0> angle 45 }
light_source { <4, 6, -4>, rgb .6 area_light x * 1.5, y * 1.5, 3, 3 }
light_source { <0, 3, 6>, rgb .5 fade_distance 5 fade_power 2 }
light_source { <-5, 3, -3>, rgb <.3, .1, .1> shadowless }
plane { y, 0 pigment { rgb .6 } }
sphere { <-1, .9, 0>, .8 pigment { rgb <.8, .9, .7> } finish { subsurface { translucency 3 } } }
light_group {
  light_source { <2, 1, -5>, rgb <.2, .4, .9> }
  sphere { <1, .9, 0>, .8 pigment { rgb <.8, .9, .9> } finish { subsurface { translucency <2, 3, 4> } } interior { ior 1.4 } }
  global_lights off
}
