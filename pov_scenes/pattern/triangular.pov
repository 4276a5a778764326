// `triangular`: its own colours on the wall, a list on the ball, pigments on the box.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { triangular rotate 30*x rotate 20*y } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { triangular rgb 1 rgb 0.3 rgb <1, 0.5, 0> rotate 20 scale 0.4 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { triangular pigment { rgb 1 } pigment { bozo scale 0.1 } scale 0.4 } }
