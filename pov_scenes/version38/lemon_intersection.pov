// Lemons cut each other, and one is taken away.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
intersection { lemon { -1.5*x, 0, 1.5*x, 0.4, 2.5 } lemon { -1.5*y, 0.3, 1.5*y, 0, 2 } pigment { rgb <0.9, 0.8, 0.2> } translate -1.2*x }
difference { box { -0.8, 0.8 } lemon { <0, -0.5, -1.5>, 0.2, <0, 0.4, 1.5>, 0.1, 2 } rotate 30*y translate 1.4*x pigment { rgb <0.3, 0.7, 0.9> } }
