// Modifiers of patterns in textures without a pattern: they have no effect.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <-3, 5, -6>, 1 }
#declare Plain = texture { turbulence 1 }
#declare Waved = texture { frequency 2 phase 0.3 ramp_wave }
sphere { -1.2*x, 1 texture { Plain pigment { rgb <1, 0.6, 0.3> } } }
sphere { 1.2*x, 1 texture { Waved pigment { rgb <0.3, 0.6, 1> } } }
