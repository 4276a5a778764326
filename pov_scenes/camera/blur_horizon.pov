// Focal blur at a horizon: the sky is opaque where the picture keeps no transparency, so that it takes no more samples.
#version 3.7;
global_settings { assumed_gamma 1 }
camera {
  location <0, 1.5, -6> look_at 0.5*y angle 40
  aperture 0.3 focal_point <0, 0.5, -1> blur_samples 16 variance 1/1000 confidence 0.95
}
light_source { <-4, 6, -6>, rgb 1 }
plane { y, 0 pigment { rgb 0.5 } }
