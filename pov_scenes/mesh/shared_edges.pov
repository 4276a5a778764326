// Many thin triangles around one corner and along shared edges let no light through.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
light_source { <0, 0, 30>, rgb <3, 0, 0> }
mesh {
  #for (I, 0, 72)
    triangle { <0.1, 0.2, 0>, <2.2*cos(I*pi/36), 1.2*sin(I*pi/36), 0.3>, <2.2*cos((I + 1)*pi/36), 1.2*sin((I + 1)*pi/36), 0.3> }
  #end
  pigment { rgb 0.9 }
}
