// Eleven greys from black to white and one beyond it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <5.5, 0, -5> look_at <5.5, 0, 0> right 12*x up 9*y }
#for (I, 0, 11)
  box { <I, -3, 0>, <I + 0.9, 3, 1> pigment { rgb I/10 } finish { ambient 1 } }
#end
