// Targets that are also passed through, by the order of the items.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.06 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <0,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
#declare Glass = sphere { <0,1.2,0>, 0.7 pigment { rgbf .9 } finish { ambient 0 diffuse .1 } interior { ior 1.5 } }
object { Glass translate -2*x photons { target refraction on pass_through } }
object { Glass photons { target pass_through refraction on } }
object { Glass translate 2*x photons { refraction on pass_through target } }
