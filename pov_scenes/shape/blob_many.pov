// Forty components along a spiral.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
blob {
  threshold 0.5
  #for (I, 0, 39)
    sphere { <1.6*cos(I/5)*(1 - I/60), -1 + I/18, 1.6*sin(I/5)*(1 - I/60)>, 0.42, 1 }
  #end
  pigment { rgb <0.8, 0.5, 0.2> }
}
