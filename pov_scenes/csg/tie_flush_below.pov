// Cylinders whose upper ends lie in a plane: POV-Ray shows the plane but where it meets their boxes before it and rounds
// the ends to be nearer.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 6, -7> look_at <0, 0.3, 0> angle 38 }
plane { y, 0 pigment { checker rgb <1, 0, 0> rgb <0.9, 0, 0> } finish { ambient 1 diffuse 0 } }
#default { finish { ambient 1 diffuse 0 } }
cylinder { <-1.2, 0, 0>, <-1.2, -0.8, 0>, 0.7 pigment { rgb <0, 1, 0> } }
cylinder { <1.2, 0, 0>, <1.2, -0.8, 0>, 0.7 pigment { rgb <0, 1, 0> } rotate 20*y }
