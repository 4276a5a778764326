// Mirrors that show mirrors.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -6> look_at <0, 0.2, 0> angle 42 }
light_source { <-4, 6, -8>, rgb 0.8 }
background { rgb <0.3, 0.4, 0.6> }
plane { y, -1 pigment { checker rgb 0.7, rgb <0.3, 0.15, 0.1> scale 0.5 } finish { diffuse 0.7 } }
#for (I, -2, 2)
  sphere { <0.95*I, -0.35 + 0.2*I*I, 0.3*I>, 0.46 pigment { rgb 0.1 } finish { diffuse 0.2 reflection 0.7 } }
#end
torus { 1.6, 0.08 rotate 70*x translate 0.4*y pigment { rgb 0.1 } finish { diffuse 0.2 reflection 0.6 } }
