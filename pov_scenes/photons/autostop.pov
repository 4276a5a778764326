// Without autostop all rings are shot, with it those behind the last that hit.
// compare: channel<=8 pixels<=0.15% because "the order of POV-Ray's map of photons hangs on the last digits of their places, and its searches miss some by that order"
#version 3.7;
global_settings { assumed_gamma 1 photons { radius .8 spacing 0.05 autostop 0 } }
camera { location <0,4,-6> look_at <0,0.4,0> }
light_source { <3,8,-2>, 1 }
plane { y, 0 pigment { rgb 1 } finish { ambient 0.05 diffuse .8 } }
torus { 1, .25 translate .6*y pigment { rgbt <1,1,1,.9> } interior { ior 1.4 } photons { target refraction on } }
