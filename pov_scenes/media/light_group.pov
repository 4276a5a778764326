// Media scatter the lights that shine on the object at the end of the ray: left the global light, in the middle that of a
// group alone, right both.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -10> look_at 0 angle 40 }
background { rgb 0.1 }
light_source { <5, 8, -9>, <1, 0.2, 0.1> }
media { scattering { 1, 0.02 } intervals 2 samples 4 }
sphere { <-2, 0, 0>, 0.8 pigment { rgb 0.5 } }
light_group {
  light_source { <-3, 3, -3>, <0.1, 1, 0.2> }
  sphere { <0, 0, 0>, 0.8 pigment { rgb 0.5 } }
  box { <-3, -2.4, -1>, <3, -1.2, 1> hollow pigment { rgbt 1 } interior { media { scattering { 1, 0.3 } } } }
}
light_group {
  light_source { <8, 3, -3>, <0.1, 0.2, 1> spotlight point_at <2, 0, 0> radius 5 falloff 12 }
  union { sphere { <2, 0, 0>, 0.8 } box { <1.5, 1, 0>, <2.5, 2, 1> } pigment { rgb 0.5 } }
  global_lights on
}
