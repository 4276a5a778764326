// Waves of marble, wood, spirals and quilted that replace those of a pigment, and stay when it gets another pattern.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6.4> look_at y angle 60 }
light_source { <-4, 7, -6>, 1 }
#declare Reds = color_map { [0 rgb <1,0,0>] [1 rgb <1,1,0>] };
#declare Veins = pigment { marble turbulence 0.4 scale 0.4 }
sphere { <-2, 1, 0>, 0.9 pigment { Veins gradient y color_map { Reds } } }
sphere { <0, 1, 0>, 0.9 pigment { wood scale 0.4 } pigment { wrinkles color_map { Reds } } }
sphere { <2, 1, 0>, 0.9 pigment { gradient x sine_wave } pigment { marble color_map { Reds } } }
sphere { <-2, -1, 0>, 0.9 pigment { spiral1 3 } pigment { quilted color_map { Reds } } }
sphere { <0, -1, 0>, 0.9 texture { pigment { Veins sine_wave } } pigment { bozo color_map { Reds } } }
sphere { <2, -1, 0>, 0.9 pigment { Veins } pigment { Veins scale 2 } }
sphere { <-2, 2.9, 0>, 0.9 pigment { gradient x frequency 4 } pigment { quilted color_map { Reds } scale 0.4 } }
sphere { <0, 2.9, 0>, 0.9 pigment { quilted } pigment { gradient y phase 0.3 color_map { Reds } } }
sphere { <2, 2.9, 0>, 0.9 pigment { wood } pigment { checker rgb 1, rgb x } }
