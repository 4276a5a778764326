// Media of method 1 are sampled at random places, by numbers that go on from pixel to pixel.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 angle 50 }
background { rgb <0.1, 0.2, 0.3> }
sphere {
  0, 1.2 hollow pigment { rgbt 1 }
  interior { media { method 1 intervals 4 samples 1, 3 emission 0.6 absorption 0.3 density { spherical scale 1.2 } } }
}
