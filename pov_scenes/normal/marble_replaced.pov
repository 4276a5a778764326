// Waves of marble, wood, quilted and checker that replace those of a normal, and stay when it gets another pattern.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -5> look_at 0 }
light_source { <-4, 7, -6>, 1 }
#default { pigment { rgb <1, 0.9, 0.7> } }
sphere { <-2, 1, 0>, 0.9 normal { marble 0.8 } normal { leopard 0.8 scale 0.1 } }
sphere { <0, 1, 0>, 0.9 normal { wood 0.8 } normal { gradient x 0.8 scale 0.4 } }
sphere { <2, 1, 0>, 0.9 normal { gradient y sine_wave slope_map { [0 <0,1>] [1 <1,-1>] } } normal { marble 0.8 scale 0.3 } }
sphere { <-2, -1, 0>, 0.9 normal { quilted 0.8 phase 0.2 } normal { ripples 0.8 scale 0.2 } }
sphere { <0, -1, 0>, 0.9 normal { checker 0.8 } normal { waves 0.8 scale 0.2 } }
sphere { <2, -1, 0>, 0.9 normal { marble 0.8 } normal { checker normal { bumps 0.3 }, normal { dents 0.5 } } }
