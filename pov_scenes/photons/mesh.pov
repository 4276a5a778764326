// A glass pyramid of triangles.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.05 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
mesh { triangle { <-1,.1,-1>, <1,.1,-1>, <.1,1.6,.1> } triangle { <1,.1,-1>, <1,.1,1>, <.1,1.6,.1> } triangle { <1,.1,1>, <-1,.1,1>, <.1,1.6,.1> }
  triangle { <-1,.1,1>, <-1,.1,-1>, <.1,1.6,.1> } triangle { <-1,.1,-1>, <1,.1,-1>, <1,.1,1> } triangle { <-1,.1,-1>, <1,.1,1>, <-1,.1,1> } inside_vector y
  rotate 15*y pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } interior { ior 1.4 } photons { target refraction on } }
