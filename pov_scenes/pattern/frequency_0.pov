// Patterns of negative values with `frequency 0`, under each wave: they are raised to 0 to 1.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> right 4*x up 3*y direction z }
#macro Stripe(Wave, At)
  #local M = color_map { [0 rgb 0] [0.4 rgb <1, 0.5, 0>] [1 rgb <0.2, 0.4, 1>] }
  #switch (Wave)
    #case (0) #local P = pigment { gradient <1, 0.3, 0> color_map { M } frequency 0 } #break
    #case (1) #local P = pigment { function { x*y } color_map { M } frequency 0 cubic_wave } #break
    #case (2) #local P = pigment { gradient x color_map { M } frequency 0 poly_wave 2 phase 0.3 } #break
    #case (3) #local P = pigment { function { atan2(y, x)/2 } color_map { M } frequency 0 turbulence 0.2 } #break
    #case (4) #local P = pigment { gradient x pigment_map { [0 rgb x] [1 rgb y] } frequency 0 scale 0.7 } #break
    #case (5) #local P = pigment { function { x - 1 } color_map { M } frequency 0 triangle_wave } #break
  #end
  box { <-3, 0, 0>, <3, 0.48, 1> pigment { P } finish { ambient 1 diffuse 0 } translate At*y }
#end
#for (I, 0, 5)
  Stripe(I, I/2 - 1.5)
#end
