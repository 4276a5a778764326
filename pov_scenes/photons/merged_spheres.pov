// Photons leave a ball of a merge where the other ball hides its surface, and go on in that one.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.05 } }
camera { location <2, 4, -5> look_at <0.4, 0.5, 0.3> angle 45 }
light_source { <-4, 8, -3>, 1.5 photons { refraction on reflection on } }
plane { y, 0 pigment { rgb 0.7 } finish { ambient 0 } }
merge {
  sphere { <0, 1, 0>, 0.7 }
  sphere { <0.6, 0.8, 0.2>, 0.6 }
  pigment { rgbf 0.9 } finish { ambient 0 diffuse 0 } interior { ior 1.5 }
  photons { target refraction on reflection on }
}
