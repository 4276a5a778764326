// Parametric surfaces whose parameters do not vary, hardly vary or are coarse, so that no halving falls to one of them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -6> look_at 0 angle 60 }
light_source { <1, 5, -4> rgb 1 }
#macro Tube(A, B, Accuracy, Gradient)
  parametric {
    function { u } function { sin(v) } function { cos(v) }
    A, B contained_by { box { -4, 4 } } max_gradient Gradient accuracy Accuracy
#end
Tube(<1, -1>, <1, 1>, .1, 1) pigment { rgb x } translate -2*x }
Tube(<0, 0>, <.09, 2*pi>, .1, 1) pigment { rgb y } translate -.5*x }
Tube(<0, 0>, <.3, 2*pi>, .4, 2) pigment { rgb <.3, .5, 1> } translate 1*x }
Tube(<-1, 1>, <1, 1>, .1, 3) pigment { rgb 1 } translate -2*y }
Tube(<1, 2>, <-.5, 0>, .01, 1) pigment { rgb <1, 1, 0> } translate <-1.5, -.5, 0> }
Tube(<0, 0>, <.7, 2*pi>, .8, 2) pigment { rgb <0, 1, 1> } translate <2, 1.2, 0> }
