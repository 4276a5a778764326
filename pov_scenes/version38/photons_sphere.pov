// Photons through a ball, whose order follows the last digits of their places.
#version 3.8;
global_settings { assumed_gamma 1 photons { spacing 0.03 } }
camera { location <0, 3, -6> look_at <0, 0.6, 0> angle 45 }
light_source { <4, 8, -2>, 1.2 }
plane { y, 0 pigment { rgb 0.8 } }
sphere {
  <0, 0.9, 0>, 0.8 pigment { rgbf <0.9, 1, 0.95, 0.95> }
  finish { specular 0.5 reflection { 0.02, 1 fresnel on } conserve_energy } interior { ior 1.5 }
  photons { target reflection off refraction on }
}
