// A prism of glass splits the light of photons.
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .4 spacing 0.06 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 parallel point_at <0,.6,0> }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
prism { -1, 1, 4, <-.8,0>, <.8,0>, <0,1.4>, <-.8,0> rotate -90*x translate .2*y
  pigment { rgbt <1,1,1,.95> } interior { ior 1.5 dispersion 1.15 dispersion_samples 5 } photons { target refraction on } }
