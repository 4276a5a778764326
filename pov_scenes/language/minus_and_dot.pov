// A sign before a component is taken after the component: `-V.x` is the negative of V.x.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare V = <0.8, 0.3, 0.5>;
sphere { <-V.x, -V.y, V.z>, 0.4 pigment { rgb <0.9, 0.6, 0.3> } }
sphere { <-V.x, V.y, 0>*-1, -V.z*-1 pigment { rgb <0.3, 0.6, 0.9> } }
