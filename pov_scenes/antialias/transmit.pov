// With an alpha channel antialiasing compares transmit as it is, not to the power of Antialias_Gamma.
// switches: +A0.22 +AM1 +R3 -J +UA
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -5> right 4*x up 3*y look_at 0 }
plane {
  z, 0
  pigment {
    gradient x triangle_wave
    color_map { [0.5 rgbt <0, 0, 0, 0.25>] [0.5 rgbt <0, 0, 0, 0.5>] }
    rotate 20*z
  }
  finish { ambient 0 diffuse 0 }
}
