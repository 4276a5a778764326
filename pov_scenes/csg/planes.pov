// Planes are half-spaces behind their normals: six of them bound a skewed block.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
intersection {
  plane { x, 0.9 }
  plane { -x, 0.9 }
  plane { <0.2, 1, 0.1>, 0.7 }
  plane { -y, 0.9 }
  plane { <0, 0.3, 1>, 0.8 }
  plane { <0.2, 0, -1>, 0.8 }
  rotate 30*y
  pigment { rgb <0.8, 0.7, 0.5> }
}
