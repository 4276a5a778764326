// A lamp in a union moves with it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
union {
  light_source { <0, 1.2, 0>, rgb 1 }
  torus { 0.7, 0.1 pigment { rgb <0.9, 0.8, 0.3> } }
  rotate 30*z translate <-0.6, 0, -0.5>
}
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
