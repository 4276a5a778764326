// Four lights of four kinds.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.07 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, <.5,.2,.2> }
light_source { <-3,8,-2>, <.2,.5,.2> parallel point_at <0,1,0> }
light_source { <1,8,3>, <.2,.2,.6> spotlight point_at <0,1,0> radius 8 falloff 15 }
light_source { <-4,5,2>, <.4,.4,.2> cylinder point_at <0,1,0> radius 1 falloff 2 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
sphere { <0,1.2,0>, 1 pigment { rgbt <1,1,1,.9> } finish { ambient 0 diffuse .1 } interior { ior 1.5 } photons { target refraction on } }
