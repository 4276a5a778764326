// Clipping by an inverse solid cuts a window; several clips act together.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1.1
  clipped_by { sphere { <0.3, 0.3, -1>, 0.6 inverse } plane { -y, 0.6 } }
  pigment { rgb <0.8, 0.8, 0.4> }
}
