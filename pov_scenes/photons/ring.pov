// A mirror ring gathers light in a heart (reflection only).
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.06 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
difference { cylinder { 0, .8*y, 2 } cylinder { -y, y, 1.9 }
  pigment { rgb <1,.8,.3> } finish { ambient 0 diffuse .2 reflection { .7 metallic } } photons { target reflection on } }
