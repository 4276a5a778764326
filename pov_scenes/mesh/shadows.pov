// A mesh throws shadows on the floor and on itself.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
mesh {
  #for (I, 0, 11)
    triangle { <0, -0.9, 0>, <1.6*cos(I*pi/6), 0.2, 1.6*sin(I*pi/6)>, <1.6*cos(I*pi/6 + 0.3), 0.9, 1.6*sin(I*pi/6 + 0.3)> }
  #end
  pigment { rgb <0.9, 0.8, 0.6> }
}
