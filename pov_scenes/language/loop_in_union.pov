// A loop and declarations inside a union's braces.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union {
  #declare Turns = 24;
  #for (I, 0, Turns - 1)
    #local Angle = I*360/Turns;
    sphere { <1.2, 0, 0>, 0.1 + 0.08*sin(radians(Angle)*3) rotate Angle*y }
  #end
  rotate -25*x
  pigment { rgb <0.8, 0.7, 0.3> }
}
