// An area light behind a pane: its shadow rays meet glass and opaque cones in either order.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -8> look_at <0, 0.5, 0> }
light_source { <1, 12, -2>, rgb 1 area_light 2*x, 2*z, 5, 5 adaptive 1 }
box { <-6, -0.2, -6>, <6, 0, 6> pigment { rgb 1 } }
cone { <-1.5, 0.5, 0>, 0.8, <-1.5, 1.2, 0>, 0.4 pigment { rgb x } }
cone { <1.5, 0.5, 0>, 0.8, <1.5, 1.2, 0>, 0.4 pigment { rgb y } }
prism { 0, 0.1, 5, <-3, -2>, <3, -2>, <3, 2>, <-3, 2>, <-3, -2> translate 2*y pigment { rgbt <1, 0.6, 0.2, 0.9> } }
