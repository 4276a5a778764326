// The last sample of method 3 lies in the surface where the ray leaves the medium, and light reaches it through the medium.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location -4*z look_at 0 }
light_source { <5, 5, -10>, 1 }
sphere {
  0, 1.3
  pigment { rgbt 1 }
  hollow
  interior { media { scattering { 1, 0.5 extinction 1 } samples 60 method 3 } }
}
