// A clear blob that bends light, with rays that start on its surface.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
blob { threshold 0.5 sphere { <-0.6, 0, 0>, 1.2, 1 } sphere { <0.6, 0.3, 0>, 1.2, 1 } pigment { rgbf <0.9, 1, 0.95, 0.9> } finish { reflection 0.1 phong 0.5 } interior { ior 1.4 } }
