// Hits up to the `tolerance` of a sphere sweep are missing: shadows near it, far walls of thin glass, parts of CSG.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0.4, 3, -5> look_at <0, 0.2, 0> angle 42 }
light_source { <20, 30, -10>, 1 }
background { rgb <0.4, 0.5, 0.7> }
plane { y, 0 pigment { checker rgb <1, 1, 0.6>, rgb <0.3, 0.3, 0.6> scale 0.31 } finish { reflection 0.2 } }
#declare Red = pigment { rgb <0.9, 0.3, 0.2> }
sphere_sweep { linear_spline 3, <-1.6, 0.2, 1>, 0.2, <-1, 0.25, -0.6>, 0.1, <-0.2, 0.6, 0.5>, 0.2 tolerance 0.3 pigment { Red } }
sphere_sweep { cubic_spline 5, <0, 0.2, -1>, 0.2, <0, 0.2, -1>, 0.2, <1, 0.3, 0>, 0.2, <1.3, 0.2, 1>, 0.2, <1, 1, 2>, 0.3 tolerance 0.45
  scale <1, 0.5, 1> pigment { rgbf <0.8, 1, 0.9, 0.8> } interior { ior 1.2 } }
intersection { sphere_sweep { linear_spline 2, <-0.7, 0.1, -1.2>, 0.35, <0.4, 0.2, -1.1>, 0.2 tolerance 0.2 } box { <-0.8, -1, -3>, <0.3, 0.3, 0> }
  translate <-0.2, 0, -0.6> pigment { Red } }
