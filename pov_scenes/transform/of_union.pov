// A transform of a union moves all its members, after their own.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union {
  sphere { 0, 0.5 translate -0.9*x }
  box { -0.4, 0.4 rotate 45*y }
  cone { -0.5*y, 0.5, 0.5*y, 0 translate 0.9*x }
  scale <1, 1.3, 1> rotate <0, 30, -25> translate 0.2*y
  pigment { rgb <0.6, 0.7, 0.4> }
}
