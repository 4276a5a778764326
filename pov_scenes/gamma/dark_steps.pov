// The straight foot of the sRGB curve: dark greys and a negative one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <6, 0, -5> look_at <6, 0, 0> right 13*x up 9*y }
#for (I, -1, 12)
  box { <I, -3, 0>, <I + 0.9, 3, 1> pigment { rgb I*0.0007 } finish { ambient 1 } }
#end
