// Coincident cylinders of different lengths in a clipped union: their distances differ in the last bit, and the nearer one
// shows; where they do not, the last one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <4.5, 5, -4.5> look_at y angle 50 }
light_source { <-6, 9, -3> rgb 1 }
plane { y, 0 pigment { rgb 0.5 } }
union {
  cylinder { 0.4*y, 2.4*y, 0.94 open pigment { rgb <0.2, 0.8, 0.3> } }
  cylinder { 0.2*y, 3*y, 0.94 open pigment { rgb <0.9, 0.3, 0.2> } }
  clipped_by { plane { z, 0 } }
}
