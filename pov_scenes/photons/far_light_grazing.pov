// Photons of a light far away that graze a ball of glass: as their points have few digits left, they meet the ball again
// and again, and go around it.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 12 photons { spacing 0.0583 } }
camera { location <1.6, 1.2, -1.4> look_at <0, 0.2, 0> angle 45 }
light_source { <-0.7, 0.24, 0.83> * 150000, <3, 2.6, 1.8> photons { refraction on reflection on } }
plane { y, 0 pigment { rgb 0.7 } finish { ambient 0 } }
sphere { 0.24 * y, 0.24
  pigment { rgbt 1 }
  finish { ambient 0 diffuse 0 reflection { 0.05, 0.95 fresnel on } conserve_energy }
  interior { ior 1.5 }
  photons { target refraction on reflection on }
}
