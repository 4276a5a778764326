// Blobs of spheres and cylinders, one with a component that takes away.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
blob { threshold 0.5 sphere { <-1.9, 0.3, 0>, 0.9, 1 } sphere { <-1.2, 0, 0>, 0.8, 1.2 } pigment { rgb <0.8, 0.5, 0.2> } }
blob { threshold 0.4 cylinder { <-0.6, -0.8, 0>, <0.7, 0.4, 0.3>, 0.6, 1 } cylinder { <0.6, -0.9, 0>, <-0.4, 0.9, 0>, 0.5, strength 1.1 } pigment { rgb <0.2, 0.5, 0.8> } }
blob { threshold 0.6 sphere { <1.7, 0, 0>, 1.2, 2 } sphere { <1.4, 0.4, -0.8>, 0.7, -1.5 } cylinder { <1.2, -1, 0>, <2.4, -1, 0>, 0.4, 1 } pigment { rgb <0.5, 0.8, 0.3> } finish { phong 0.5 } }
