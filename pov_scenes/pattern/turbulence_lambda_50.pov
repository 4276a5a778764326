// Turbulence whose sixth octave is so fine that its coordinates do not fit into 32 bits beyond |x| = 6.87.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -10*z right 20*x up 15*y look_at 0 }
plane { z, 1 pigment { bumps turbulence 1 lambda 50 } finish { ambient 1 diffuse 0 } }
