// Radiosity: settings of rad_def.inc, outdoors.
#version 3.7;
#include "rad_def.inc"
global_settings { assumed_gamma 1 radiosity { Rad_Settings(Radiosity_OutdoorLQ, off, off) } }
sky_sphere { pigment { gradient y color_map { [0 rgb <.9, .9, 1>] [1 rgb <.2, .4, .9>] } } }
camera { location <0, 2, -6> look_at <0, .8, 0> }
light_source { <50, 80, -30>, rgb <.9, .8, .6> parallel point_at 0 }
plane { y, 0 pigment { rgb <.6, .7, .5> } finish { diffuse .7 } }
union {
  torus { 1, .35 translate .35*y }
  box { <-.5, 0, 1.5>, <2.5, 1.6, 2> }
  blob { threshold .4 sphere { <-2, .6, .5>, 1, 1 } sphere { <-1.5, 1, .8>, .8, 1 } }
  pigment { rgb <.9, .85, .8> } finish { diffuse .75 }
}
