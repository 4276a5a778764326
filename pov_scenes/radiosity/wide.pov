// Radiosity: the first pass has rays farther apart than blocks, and samples that meet nothing lie under a sky.
// size: 440x120
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 20 } }
background { rgb <0.5, 0.6, 0.8> }
camera { location <0, 3, -8> right 3.67*x look_at <0, 1, 0> angle 90 }
plane { y, 0 pigment { rgb <0.9, 0.8, 0.7> } finish { diffuse 0.7 } }
#for (I, 0, 6)
  box { <2*I - 6.5, 0, 0>, <2*I - 5.5, 1.5, 1> pigment { rgb <0.3 + 0.1*I, 0.6, 0.9 - 0.1*I> } finish { diffuse 0.7 } }
#end
