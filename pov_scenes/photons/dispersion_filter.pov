// Dispersed photons through a slab whose faces filter differently: from the second wavelength on, POV-Ray filters as by
// the face that the one before left through.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.04 gather 20, 100 radius 0.3 } }
camera { orthographic location <0, -0.2, 0> right 0.5*x up 0.5*y direction -y look_at -y }
light_source { <0, 100, 0> rgb 0.8 photons { refraction on reflection on } rotate -30*z }
plane { y, -1 pigment { rgb 0.9 } finish { diffuse 1 ambient 0 } }
box {
  <-4, 0, -4>, <4, 0.5, 4>
  pigment { gradient y color_map { [0.5 rgbf <0.2, 0.4, 0.3, 1>] [0.5 rgbf 1] } translate -0.3*y }
  finish { diffuse 0 ambient 0 }
  interior { ior 1.5 dispersion 1.1 dispersion_samples 7 }
  photons { target refraction on reflection off }
}
