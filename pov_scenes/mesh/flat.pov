// A few flat triangles in one mesh, open on all sides and seen from both.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
mesh {
  triangle { <-1.6, -1, 0>, <0, -1, -0.6>, <-0.6, 1, 0.3> }
  triangle { <0, -1, -0.6>, <-0.6, 1, 0.3>, <0.9, 0.9, 0.7> }
  triangle { <0, -1, -0.6>, <0.9, 0.9, 0.7>, <1.7, -1, 0.4> }
  pigment { rgb <0.9, 0.7, 0.4> }
}
