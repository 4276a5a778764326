// Shows vturbulence, vaxis_rotate and two streams of random numbers moving a chain of balls.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 1 }
#declare One = seed(7); #declare Two = seed(-3);
#for (I, 0, 60)
  #declare Place = vaxis_rotate(<2, 0, 0>, <1, 2, 0.5>, 6 * I);
  sphere {
    Place + vturbulence(2, 0.5, 6, Place * 1.3), 0.1 + 0.1 * rand(One)
    pigment { rgb <rand(Two), rand(One), rand(Two)> }
  }
#end
