// Transmittance below zero: negative transmit and filter, and colours below 0.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -10*z look_at 0 right 16*x up 12*y }
plane { z, 5 pigment { checker rgb <0.2, 0.3, 0.4>, rgb <0.4, 0.3, 0.2> } finish { ambient 1 diffuse 0 } }
#default { finish { ambient 0 diffuse 0 emission 0.5 } }
#macro Row(Y, Ior)
  #local Clear = array[4] { rgbt <0.5, 0.5, 0.5, -1.3>, rgbt <0.5, 0.5, 0.5, 2.3>, rgbf <0.5, 0.5, 0.5, -0.9>, rgbf <-1, -0.5, -0.5, 1> };
  #for (I, 0, 3)
    box { <-1.5, -1.5, 0>, <1.5, 1.5, 0.1> pigment { rgbt <0.1, 0.4, 0.2, 0.3> } pigment { Clear[I] } interior { ior Ior } translate <4*I - 6, Y, 0> }
  #end
#end
Row(2.5, 1)
Row(-2.5, 1.3)
