// Focal blur, whose points on the lens have the jitter of another row than in 3.7.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at <0, 0.6, 0> angle 40 focal_point <0, 0.6, 0> aperture 0.4 blur_samples 7 }
light_source { <6, 8, -6> rgb 1 }
plane { y, 0 pigment { checker rgb 1 rgb 0.2 } }
#for (I, -2, 2)
  sphere { <I, 0.5, I*1.2>, 0.5 pigment { rgb <0.5 + I/4, 0.4, 0.5 - I/4> } finish { phong 0.8 } }
#end
