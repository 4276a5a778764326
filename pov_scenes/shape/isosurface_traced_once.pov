// A cut by an isosurface is exact, but without `max_trace` only its first surface on a ray can be seen.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2.1, 2.4, -5.2> look_at 0 angle 34 }
light_source { <5, 8, -6>, rgb 1 }
background { rgb 0.3 }
plane { y, -1.4 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Cut = isosurface {
  function { x*x + y*y*y*y + z*z - 0.7 }
  contained_by { box { -1.1, 1.1 } }
  max_gradient 6 accuracy 1e-6
}
difference {
  box { -1, 1 pigment { rgb <0.9, 0.5, 0.3> } }
  object { Cut translate <0.5, 0.5, -0.5> pigment { rgb <0.3, 0.8, 0.4> } }
}
