// Spheres and boxes along splines of each kind, and a colour from one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2.5, 2, -9> look_at <2.5, 2, 0> angle 45 }
light_source { <-4, 6, -8>, rgb 1 }
#declare S = spline { linear_spline 0, <0, 0, 0>, 1, <1, 3, 0>, 2, <2, 1, 0>, 3, <4, 4, 0>, 4.5, <5, 0, 0> }
#declare C = spline { natural_spline 0, <1, 0, 0>, 2, <0.2, 1, 0>, 4.5, <0, 0, 1> }
#for (I, 0, 4.5, 0.25)
  sphere { S(I), 0.1 pigment { rgb C(I) } }
  sphere { S(I, quadratic_spline), 0.1 pigment { rgb 1 } }
  box { -0.08, 0.08 translate S(I, cubic_spline) pigment { rgb <1, 1, 0> } }
  box { -0.08, 0.08 rotate 45 translate S(I, natural_spline) + 0.1*z pigment { rgb <0, 1, 1> } }
#end
