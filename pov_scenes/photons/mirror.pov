// A flat mirror throws a patch of light on a wall.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.04 } }
camera { location <0,4,-6> look_at <0,0.8,0> }
light_source { <3,7,-4>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
plane { -z, -3 pigment { rgb <1,.9,.8> } finish { ambient 0.05 diffuse .7 } }
box { <-1,0,-.7>, <1,.1,.7> rotate <-8,10,4> translate .3*y pigment { rgb .1 } finish { ambient 0 diffuse .1 reflection .85 }
  photons { target reflection on } }
