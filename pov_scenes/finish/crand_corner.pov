// The first numbers of `crand` are those of POV-Ray.
// size: 1x1
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
box { -20, 20 translate 30*z pigment { rgb <0.8, 0.7, 0.6> } finish { crand 0.4 ambient 0.2 diffuse 0.7 } }
light_source { <-3, 8, -9>, rgb 0.5 }
