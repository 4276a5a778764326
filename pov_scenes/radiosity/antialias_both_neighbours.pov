// Radiosity: where a pixel differs from both neighbours, their grids are traced before its own.
// switches: +A0.1 +R2
#version 3.7;
global_settings { assumed_gamma 1 radiosity { always_sample on count 20 minimum_reuse .005 maximum_reuse .05 } }
background { rgb <.3, .4, .5> }
camera { location <0, 3, -7> look_at <0, 1.5, 0> angle 60 }
light_source { <1.5, 4.5, -1.5>, rgb <.8, .72, .64> }
box {
  <-4, 0, -8>, <4, 5, 4> inverse
  pigment { checker rgb <.9, .3, .2> rgb .9 } finish { ambient .2 diffuse .7 specular .4 } 
}
#declare Dull = finish { ambient .1 diffuse .6 phong .5 }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <.2, .8, .3> } finish { Dull  } }
cylinder { <1.5, 0, 1>, <1.5, 2, 1>, .8 pigment { rgb <.3, .4, 1> } finish { Dull reflection .3 } }
