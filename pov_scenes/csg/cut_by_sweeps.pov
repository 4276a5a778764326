// A difference does not cut away what lies in all spheres of a segment of the sweep.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -7> look_at <0, 0.1, 0> angle 38 }
light_source { <5, 8, -9> 1 }
difference {
  box { <-2.2, -1, 0>, <2.2, 1, 1> }
  sphere_sweep { linear_spline 2, <-1.5, 0, -0.1>, 0.5, <-1.5, 0.3, 0>, 0.5 pigment { rgb <0.2, 0.8, 0.3> } }
  sphere_sweep { linear_spline 3, <-0.5, 0, 0>, 0.4, <0.1, 0.3, 0>, 0.3, <0.2, -0.4, 0>, 0.1 pigment { rgb <0.2, 0.8, 0.3> } }
  sphere_sweep { linear_spline 2, <0.9, -0.6, 0>, 0.3, <1.4, 0.3, -0.1>, 0.6 pigment { rgb <0.2, 0.8, 0.3> } }
  pigment { rgb <1, 0.5, 0.4> }
}
