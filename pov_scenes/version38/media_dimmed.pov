// Light of a medium, dimmed by the optical depth of each step itself: an emission that is absorbed, in one step and in three.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at <0, 0.7, 0> angle 45 }
light_source { <3, 6, -4> rgb 1.5 }
plane { y, 0 pigment { checker rgb 0.8 rgb 0.4 } }
#declare Ember = media { emission <0.9, 0.5, 0.2> absorption <1, 2, 3> samples 2 density { boxed } }
sphere { 0, 0.9 pigment { rgbt 1 } hollow interior { media { Ember } } translate <1, 1, 0> }
sphere { 0, 0.9 pigment { rgbt 1 } hollow interior { media { Ember samples 6 } } translate <-1, 1, 0> }
